# Branch of periodic motions of a system: RMS of the transmission error of each mesh, stable and unstable, with the sweeps (above);
# largest modulus of the multipliers (below).
# Variables from gear-plot: tsv, heading, note1.., notes, height, meshes, labels, stable, unstable, up, down (1: there are some), most,
# largest, frequency_from, frequency_to, speed_label, level_label, level_low, level_high.
load plots . "/common.gp"

array colour[8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444", "#56b4e9", "#882255"]
lift = room(notes)
set multiplot title heading offset 0, -0.4
span = frequency_to - frequency_from
set xrange [frequency_from - 0.01 * span : frequency_to + 0.01 * span]
set lmargin at screen 0.112
set rmargin at screen 0.80
middle = lift + 0.36 * (1 - lift)
set tmargin at screen 1 - 100.0 / height
set bmargin at screen middle + 0.05
if (level_label eq "") { set yrange [0 : most] } else { set yrange [level_low : level_high] }
set xlabel speed_label offset 0, 0.3
set ylabel "RMS of the transmission error (" . (level_label eq "" ? "µm" : level_label) . ")"
set key at screen 0.815, graph 1.02 left top Left reverse vertical samplen 2.4 spacing 1.3 font ",13" noenhanced
# Meshes that are alike lie on each other: the wider line below shows.
thick(m) = 2 + 1.2 * (meshes - m)
drawn = ""
do for [m = 1:int(meshes)] {
  if (stable) { drawn = drawn . sprintf('tsv index "[stable]" using 1:%d with lines lt 1 lw %g lc rgb "%s" notitle, ', m + 2, thick(m), colour[m]) }
  drawn = drawn . sprintf('keyentry with lines lt 1 lw 3 lc rgb "%s" title word(labels, %d), ', colour[m], m)
}
do for [m = 1:int(meshes)] {
  if (unstable) { drawn = drawn . sprintf('tsv index "[unstable]" using 1:%d with lines lt 1 lw 2 dt (6, 5) lc rgb "%s" notitle, ', m + 2, colour[m]) }
  if (up) { drawn = drawn . sprintf('tsv index "[sweep up]" using 1:%d with points pt 2 ps 0.9 lw 1.6 lc rgb "%s" notitle, ', m + 1, colour[m]) }
  if (down) { drawn = drawn . sprintf('tsv index "[sweep down]" using 1:%d with points pt 6 ps 1.1 lw 1.4 lc rgb "%s" notitle, ', m + 1, colour[m]) }
}
drawn = drawn . 'keyentry with lines lt 1 lw 3 lc rgb "#222222" title "stable orbits", '
if (unstable) { drawn = drawn . 'keyentry with lines lt 1 lw 2 dt (6, 5) lc rgb "#222222" title "unstable orbits", ' }
if (up) { drawn = drawn . 'keyentry with points pt 2 ps 0.9 lw 1.6 lc rgb "#222222" title "sweep, rising", ' }
if (down) { drawn = drawn . 'keyentry with points pt 6 ps 1.1 lw 1.4 lc rgb "#222222" title "sweep, falling", ' }
eval("plot " . drawn[1:strlen(drawn) - 2])
set tmargin at screen middle - 0.04
set bmargin at screen lift + 105.0 / height
set yrange [0 : largest]
set ylabel "Largest multiplier" offset -1, 0
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 2 lc rgb "#444444"
drawn = ""
if (stable) { drawn = drawn . 'tsv index "[stable]" using 1:2 with lines lt 1 lw 2.4 lc rgb "#0072b2" title "stable", ' }
if (unstable) { drawn = drawn . 'tsv index "[unstable]" using 1:2 with lines lt 1 lw 2.4 dt (6, 5) lc rgb "#d55e00" title "unstable", ' }
eval("plot " . drawn[1:strlen(drawn) - 2])
unset arrow 1
eval(below)
unset multiplot
