# Figure 15: net mesh force of the lumped model over two mesh periods, upper (a) and lower branch (b).
# Variables from gear-plot: tsv, title, note1, note2, curves, labels_upper, labels_lower, force_max, static_force.
set datafile separator tab
set datafile commentschars "#"

array colour[2] = ["#1f4e9c", "#c8201e"]
set linetype 1 lc rgb colour[1] lw 2.8 dt solid
set linetype 2 lc rgb colour[2] lw 2.0 dt (9, 5)

set multiplot layout 1, 2 title title . "\n{/*0.68 solid: " . note1 . "; stated, so that the branches stand where P2000 shows them}" \
  . "\n{/*0.68 dashed: " . note2 . "; those of the static stiffness}" offset 0, -0.4 \
  margins screen 0.1, 0.975, 0.235, 0.845 spacing screen 0.075
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set tics out nomirror
set xrange [0:2]
set xtics 0.5
set mxtics 5
set mytics 2
set yrange [-0.03 * force_max : 1.1 * force_max]
set arrow from graph 0, first static_force to graph 1, first static_force nohead back lt 1 lc rgb "#9a9a9a" lw 1.4 dt (18, 10)
set key font ",13" samplen 2 spacing 1.2 Left reverse center bottom vertical maxrows 2

set key at screen 0.31, screen 0.012
set xlabel "Time (mesh periods, 0: pitch point)\n{/:Bold (a)} upper branch"
set ylabel "Net mesh force (N)"
plot for [i = 1:curves] tsv index "[upper ".i."]" using 1:2 with lines lt i title word(labels_upper, i), \
  keyentry with lines lt 1 lc rgb "#9a9a9a" lw 1.4 dt (18, 10) title sprintf("static %.0f N", static_force)
set key at screen 0.785, screen 0.012
unset ylabel
set xlabel "Time (mesh periods, 0: pitch point)\n{/:Bold (b)} lower branch"
plot for [i = 1:curves] tsv index "[lower ".i."]" using 1:2 with lines lt i title word(labels_lower, i)
unset multiplot
