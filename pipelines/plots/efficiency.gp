# Efficiency (a) and power lost (b) over speed at each torque, both sweep directions; moments of friction over a mesh period (c).
# Variables from gear-plot: tsv, heading, note1, note2, ..., notes, height, labels, gears, curves, power_max,
# efficiency_min, efficiency_max, beyond_backlash, frequency_from, frequency_to, natural_frequency.
load plots . "/common.gp"
lift = room(notes)

# Of both directions of torque t.
rings(t, column) = sprintf('tsv index "[%d up]" using ($7 > 0 ? $1 : NaN):%d with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" notitle, ', t, column) \
  . sprintf('tsv index "[%d down]" using ($7 > 0 ? $1 : NaN):%d with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" notitle, ', t, column)
ring_key = beyond_backlash > 0 ? ', keyentry with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" title "beyond backlash"' : ''
set multiplot title heading offset 0, -0.3
set tics out nomirror font ",14"
set mxtics 5
set lmargin at screen 0.12
set rmargin at screen 0.78
set key at graph 1.01, graph 0.98 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced

span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
set xlabel speed_label offset 0, 0.3
if (natural_frequency > frequency_from && natural_frequency < frequency_to) {
  set arrow from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.2 dt (18, 10)
  set label 11 "f_n" at natural_frequency, graph 0.92 offset 0.5, 0 left tc rgb "#505050" font ",14"
}
set tmargin at screen 0.87 + 0.4 * lift
set bmargin at screen 0.67 + 0.5 * lift
range = efficiency_max - efficiency_min
range = range > 0 ? range : 0.1
set yrange [efficiency_min - 0.08 * range : efficiency_max + 0.12 * range]
set ylabel "Efficiency (%)"
set label 1 "{/:Bold (a)} efficiency of the mesh, friction alone; dotted: without vibration" at graph 0, graph 1 offset 0, 0.8 font ",14"
drawn = ''
do for [t = 1:curves] {
  drawn = drawn . sprintf('tsv index "[%d down]" using 1:2 with lines lt 1 lw 2 dt (10, 5) lc rgb "%s" notitle, ', t, colour[t]) \
    . sprintf('tsv index "[%d up]" using 1:2 with lines lt 1 lw 2 lc rgb "%s" title word(labels, %d), ', t, colour[t], t) \
    . sprintf('tsv index "[%d rest]" using 1:2 with lines lt 1 lw 2.2 dt (3, 4) lc rgb "%s" notitle, ', t, colour[t]) \
    . (beyond_backlash > 0 ? rings(t, 2) : '')
}
eval("plot " . drawn . 'keyentry with lines lt 1 lw 2 dt (10, 5) lc rgb "#505050" title "dashed: falling"' . ring_key)

set tmargin at screen 0.56 + 0.5 * lift
set bmargin at screen 0.36 + 0.5 * lift
set yrange [0 : 1.08 * power_max]
set ylabel "Power lost (W)"
set label 1 "{/:Bold (b)} mean power that friction takes"
drawn = ''
do for [t = 1:curves] {
  drawn = drawn . sprintf('tsv index "[%d down]" using 1:3 with lines lt 1 lw 2 dt (10, 5) lc rgb "%s" notitle, ', t, colour[t]) \
    . sprintf('tsv index "[%d up]" using 1:3 with lines lt 1 lw 2 lc rgb "%s" title word(labels, %d), ', t, colour[t], t) \
    . (beyond_backlash > 0 ? rings(t, 3) : '')
}
eval("plot " . drawn . 'keyentry with lines lt 1 lw 2 dt (10, 5) lc rgb "#505050" title "dashed: falling"' . ring_key)

unset arrow
unset label 11
set tmargin at screen 0.25 + 0.5 * lift
set bmargin at screen 0.08 + 1.0 * lift
set xrange [0 : 1]
set yrange [* : *]
set xlabel "Mesh phase (mesh periods)" offset 0, 0.3
set ylabel "Moment (N m)"
set label 1 sprintf("{/:Bold (c)} at rest, %s: moments of friction about the axes, positive where they act as the normal force does", word(labels, 1))
plot 0 with lines lt 1 lw 1 lc rgb "#9a9a9a" notitle, \
  tsv index "[cycle]" using 1:2 with lines lt 1 lw 2.4 lc rgb "#0072b2" title word(gears, 1), \
  tsv index "[cycle]" using 1:3 with lines lt 1 lw 2.4 lc rgb "#d55e00" title word(gears, 2), \
  tsv index "[cycle]" using 1:4 with lines lt 1 lw 2.4 dt (4, 3) lc rgb "#444444" title "work lost per angle"
eval(below)
unset multiplot
