# Figure 15: net mesh force of lumped models over two mesh periods, a panel for each mesh frequency, a curve for each sweep.
# Variables from gear-plot: tsv, heading, note1.., curves, panels, labels_a, labels_b, force_max, static_force.
load plots . "/common.gp"

set for [i = 1:6] linetype i lc rgb colour[i] lw 2.4
set linetype 1 dt solid
set linetype 2 dt (9, 5)
set linetype 3 dt (3, 3)
set linetype 4 dt (12, 4, 3, 4)
set linetype 5 dt (20, 6)
set linetype 6 dt (2, 5)

lift = room(curves)
set multiplot title heading offset 0, -0.4
set xrange [0:2]
set xtics 0.5
set mxtics 5
set mytics 2
set yrange [-0.03 * force_max : 1.1 * force_max]
set arrow from graph 0, first static_force to graph 1, first static_force nohead back lt 1 lc rgb "#606060" lw 1.4 dt (18, 10)
set key font ",13" samplen 3 spacing 1.2 Left reverse center bottom vertical
letters = "a b"
set tmargin at screen 0.87 - 0.023 * curves + lift
set bmargin at screen 0.2 + 0.025 * curves + lift
do for [p = 1:panels] {
  set lmargin at screen p == 1 ? 0.118 : 0.575
  set rmargin at screen panels == 1 ? 0.965 : 0.485 + (p - 1) * 0.48
  set key at screen panels == 1 ? 0.535 : 0.29 + (p - 1) * 0.48, screen 0.012 + lift
  set xlabel "Time (mesh periods, 0: pitch point)\n{/:Bold (" . word(letters, p) . ")}"
  if (p == 1) { set ylabel "Net mesh force (N)" } else { unset ylabel }
  plot for [i = 1:curves] tsv index "[".word(letters, p)." ".i."]" using 1:2 with lines lt i title word(value("labels_".word(letters, p)), i), \
    keyentry with lines lt 1 lc rgb "#606060" lw 1.4 dt (18, 10) title sprintf("T / r_b = %.0f N", static_force)
}
eval(below)
unset multiplot
