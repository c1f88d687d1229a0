# Figure 13: mesh stiffness over a mesh period (a) and its harmonics (b), one curve per torque, and the rectangular wave.
# Variables from gear-plot: tsv, heading, note1, note2, curves, labels, rectangle_label.
load plots . "/common.gp"
lift = room(2)

array mark[6] = [1, 6, 4, 2, 8, 12]   # + o square x triangle diamond
set for [i = 1:6] linetype i lc rgb colour[i] lw 2.6 pt mark[i] ps 2.0
set linetype 1 dt (3, 3)
set linetype 2 dt (10, 5)
set linetype 3 dt solid

set multiplot layout 1, 2 title heading offset 0, -0.4 \
  margins screen 0.1, 0.985, (curves > 5 ? 0.28 : 0.245) + lift, 0.815 + lift spacing screen 0.1
# One legend of both panels, below them.
set key at screen 0.535, screen 0.012 + lift center bottom Left reverse vertical maxrows (curves > 2 ? curves > 5 ? 3 : 2 : 1) samplen 2.5 spacing 1.2 font ",14"

set xlabel "Mesh phase (mesh periods, 0: pitch point)\n{/:Bold (a)}"
set ylabel "Mesh stiffness (N/µm)"
set xrange [0:1]
set offsets graph 0, graph 0, graph 0.04, graph 0.04
set mxtics 2
plot tsv index "[rectangular wave]" using 1:2 with lines lt 1 dt solid lw 3 lc rgb "black" notitle, \
  for [i = 1:curves] tsv index "[mesh_stiffness]" using 1:i + 1 with lines lt i notitle, \
  keyentry with linespoints lt 1 dt solid lw 2.2 pt 3 lc rgb "black" title rectangle_label, \
  for [i = 1:curves] keyentry with linespoints lt i title word(labels, i)

# stems side by side, so that none hides another
shift(i) = 0.14 * (i - 0.5 * curves)
unset key
set xlabel "Harmonic of the mesh frequency\n{/:Bold (b)}"
set ylabel "Amplitude (N/µm)"
set offsets 0, 0, 0, 0
set xrange [0.4:10.6]
set yrange [0:*]
set xtics 1
set mxtics 1
set grid noxtics
plot tsv index "[rectangular wave harmonics]" using ($1 + shift(0)):2 with impulses lt 1 dt solid lw 1.6 lc rgb "black" \
    notitle, \
  for [i = 1:curves] tsv index "[mesh_stiffness harmonics]" using ($1 + shift(i)):i + 1 \
    with impulses lt 1 dt solid lw 1.6 lc rgb colour[i] notitle, \
  tsv index "[rectangular wave harmonics]" using ($1 + shift(0)):2 with points pt 3 ps 2 lw 2.2 lc rgb "black" \
    notitle, \
  for [i = 1:curves] tsv index "[mesh_stiffness harmonics]" using ($1 + shift(i)):i + 1 \
    with points lt i dt solid lw 2.2 notitle
eval(below)
unset multiplot
