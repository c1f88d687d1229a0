# A cracked tooth: static transmission error with and without its crack about the mesh periods in which it works (a), what the
# crack adds (b), the spectrum in orders of the mesh frequency (c), the largest root stress of each tooth about the cracked one (d).
# Variables from gear-plot: tsv, heading, note1, note2, ..., notes, around, last_order, top, cracked_gears: those with root stress,
# labels, stress_max: theirs.
load plots . "/common.gp"
lift = room(notes)

set multiplot layout (cracked_gears > 0 ? 4 : 3), 1 title heading offset 0, -0.4 \
  margins screen 0.1, 0.98, 0.1 + lift, 0.84 + lift spacing screen 0.09
set key top right horizontal samplen 3

set xlabel "Mesh periods from the one with the largest mark {/:Bold (a)}"
set ylabel "Transmission\nerror (µm)" offset 0.3, 0
set xrange [-around:around + 1]
stats tsv index "[transmission_error]" using 2 name "WITH" nooutput
stats tsv index "[transmission_error]" using 3 name "WITHOUT" nooutput
least = WITHOUT_min < WITH_min ? WITHOUT_min : WITH_min
if (WITH_max > least) { set ytics step_of((WITH_max - least) / 4) }
plot tsv index "[transmission_error]" using 1:3 with lines lw 1.6 dt (6, 4) lc rgb "#444444" title "without the crack", \
  tsv index "[transmission_error]" using 1:2 with lines lw 1.8 lc rgb "#c8201e" title "with the crack"
set key off
set xlabel "Mesh periods {/:Bold (b)}"
set ylabel "Added (µm)" offset 1, 0
stats tsv index "[transmission_error]" using 4 name "ADDED" nooutput
# A crack that adds nothing has no marks of its own.
if (ADDED_max > 0) { set ytics step_of(ADDED_max / 4) }
plot tsv index "[transmission_error]" using 1:4 with lines lw 1.8 lc rgb "#c8201e"

set key top right horizontal samplen 3
set ytics autofreq
set logscale y
set format y "10^{%L}"
set yrange [(top > 1e-3 ? 1e-5 : 1e-6 * top):top]
set xrange [0:last_order]
set xtics 0.5
set xlabel "Order of the mesh frequency {/:Bold (c)}"
set ylabel "Amplitude (µm)" offset 1, 0
plot tsv index "[orders]" using 1:2 with impulses lw 1.8 lc rgb "#c8201e" title "with the crack", \
  tsv index "[orders without]" using 1:2 with points pt 6 ps 1.6 lw 2 lc rgb "#444444" title "without"

if (cracked_gears > 0) {
  unset logscale y
  set format y "%g"
  set yrange [0:*]
  set xrange [-around - 0.5:around + 0.5]
  set xtics 1
  set xlabel "Tooth, counter-clockwise from the cracked one {/:Bold (d)}"
  set ylabel "Root stress\n(MPa)" offset -0.6, 0
  set ytics step_of(stress_max / 4)
  set key bottom right noenhanced
  array colour[2] = ["#c8201e", "#0072b2"]
  drawn = ""
  do for [g = 1:int(cracked_gears)] {
    drawn = drawn . sprintf('tsv index "[teeth %d]" using 1:3 with lines lw 1.6 dt (6, 4) lc rgb "#444444" title (%d > 1 ? "" : "intact tooth"), ', g, g)
    drawn = drawn . sprintf('tsv index "[teeth %d]" using 1:2 with points pt 7 ps 1.6 lc rgb "%s" title word(labels, %d), ', g, colour[g], g)
  }
  eval("plot " . drawn)
}
eval(below)
unset multiplot
