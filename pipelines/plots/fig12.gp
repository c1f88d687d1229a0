# Figure 12: static transmission error over a mesh period (a) and its harmonics (b), one curve per torque.
# Variables from gear-plot: tsv, heading, note1, curves, labels.
load plots . "/common.gp"
lift = room(1)

array mark[6] = [1, 6, 4, 2, 8, 12]   # + o square x triangle diamond
set for [i = 1:6] linetype i lc rgb colour[i] lw 2.6 pt mark[i] ps 2.0
set linetype 1 dt (3, 3)
set linetype 2 dt (10, 5)
set linetype 3 dt solid

set multiplot layout 1, 2 title heading offset 0, -0.4 \
  margins screen 0.085, 0.985, (curves > 4 ? 0.225 : 0.20) + lift, 0.855 + lift spacing screen 0.1
# One legend of both panels, below them.
set key at screen 0.535, screen 0.02 + lift center bottom Left reverse vertical maxrows (curves > 4 ? 2 : 1) samplen 3 spacing 1.2

set xlabel "Mesh phase (mesh periods, 0: pitch point)\n{/:Bold (a)}"
set xrange [0:1]
# From 0, unless that would leave the variation no room, as where bearings give way.
stats tsv index "[transmission_error]" using 2 nooutput name "first"
close = curves == 1 && first_max - first_min < 0.15 * first_max
set ylabel "Static transmission error (µm)" offset (close ? 1.5 : 0), 0
set yrange [(close ? first_min - 0.5 * (first_max - first_min) : 0):*]
set mxtics 2
plot for [i = 1:curves] tsv index "[transmission_error]" using 1:i + 1 with lines lt i notitle, \
  for [i = 1:curves] keyentry with linespoints lt i title word(labels, i)

# stems side by side, so that none hides another
shift(i) = 0.16 * (i - 0.5 * (curves + 1))
unset key
set xlabel "Harmonic of the mesh frequency\n{/:Bold (b)}"
set ylabel "Amplitude (µm)" offset 0, 0
set yrange [0:*]
set xrange [0.4:10.6]
set xtics 1
set mxtics 1
set grid noxtics
plot for [i = 1:curves] tsv index "[transmission_error harmonics]" using ($1 + shift(i)):i + 1 \
    with impulses lt 1 dt solid lw 1.6 lc rgb colour[i] notitle, \
  for [i = 1:curves] tsv index "[transmission_error harmonics]" using ($1 + shift(i)):i + 1 \
    with points lt i dt solid lw 2.2 notitle
eval(below)
unset multiplot
