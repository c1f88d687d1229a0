# Sidebands: static transmission error over the hunting period (a), its spectrum in orders of the mesh frequency (b), and that
# of the dynamic transmission error (c). Variables from gear-plot: tsv, heading, note1, note2, periods, last_order, top_at_rest, top_in_motion, speed.
load plots . "/common.gp"
lift = room(2)

set multiplot layout 3, 1 title heading offset 0, -0.4 \
  margins screen 0.1, 0.98, 0.1 + lift, 0.835 + lift spacing screen 0.1
set key off

set xlabel "Mesh periods {/:Bold (a)}"
set ylabel "Static transmission\nerror (µm)" offset 0.3, 0
stats tsv index "[transmission_error]" using 2 name "ERROR" nooutput
if (ERROR_max > ERROR_min) { set ytics step_of((ERROR_max - ERROR_min) / 4) }
set xrange [0:periods]
plot tsv index "[transmission_error]" using 1:2 with lines lw 1.4 lc rgb "#1f4e9c"

set logscale y
set format y "10^{%L}"
set ytics 100
set mytics 1
# Fixed at both ends: gnuplot stops where all amplitudes lie below an axis that begins at 1e-5 µm.
bottom(top) = top > 1e-3 ? 1e-5 : 1e-6 * top
set yrange [bottom(top_at_rest):top_at_rest]
set xrange [0:last_order]
set xtics 0.5
set xlabel "Order of the mesh frequency, at rest {/:Bold (b)}"
set ylabel "Amplitude (µm)"
plot tsv index "[orders at rest]" using 1:2 with impulses lw 1.8 lc rgb "#1f4e9c"
set xlabel "Order of the mesh frequency, in motion at " . speed . " {/:Bold (c)}"
set yrange [bottom(top_in_motion):top_in_motion]
plot tsv index "[orders in motion]" using 1:2 with impulses lw 1.8 lc rgb "#c8201e"
eval(below)
unset multiplot
