# A cracked tooth: static transmission error with and without its crack about the mesh periods in which it works (a), what the
# crack adds (b), and the spectrum in orders of the mesh frequency (c). Variables from gear-plot: tsv, heading, note1, note2,
# around, last_order, top.
set datafile separator tab
set datafile commentschars "#"
lift = room(2)

set multiplot layout 3, 1 title heading offset 0, -0.4 \
  margins screen 0.085, 0.985, 0.12 + lift, 0.825 + lift spacing screen 0.12
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set tics out nomirror
set key top right horizontal samplen 3

set xlabel "Mesh periods from the one with the largest mark {/:Bold (a)}"
set ylabel "Static transmission\nerror (µm)"
set xrange [-around:around + 1]
plot tsv index "[transmission_error]" using 1:3 with lines lw 1.6 dt (6, 4) lc rgb "#444444" title "without the crack", \
  tsv index "[transmission_error]" using 1:2 with lines lw 1.8 lc rgb "#c8201e" title "with the crack"
set key off
set xlabel "Mesh periods {/:Bold (b)}"
set ylabel "Added (µm)"
stats tsv index "[transmission_error]" using 4 name "ADDED" nooutput
# A crack that adds nothing has no marks of its own.
digit = ADDED_max > 0 ? 10**floor(log10(ADDED_max / 3)) : 1
if (ADDED_max > 0) { set ytics digit * ceil(ADDED_max / 3 / digit) }
plot tsv index "[transmission_error]" using 1:4 with lines lw 1.8 lc rgb "#c8201e"

set key top right horizontal samplen 3
set ytics autofreq
set logscale y
set format y "10^{%L}"
set yrange [(top > 1e-3 ? 1e-5 : 1e-6 * top):top]
set xrange [0:last_order]
set xtics 0.5
set xlabel "Order of the mesh frequency {/:Bold (c)}"
set ylabel "Amplitude (µm)"
plot tsv index "[orders]" using 1:2 with impulses lw 1.8 lc rgb "#c8201e" title "with the crack", \
  tsv index "[orders without]" using 1:2 with points pt 6 ps 1.6 lw 2 lc rgb "#444444" title "without"
eval(below)
unset multiplot
