# Root stress of both gears while a tooth passes through the mesh (a), the largest over speed (b), dynamic factors beside K_v (c).
# Variables from gear-plot: tsv, heading, line1, line2, ..., notes, height, labels, iso, iso_driver, iso_driven, path_start, path_end,
# stress_max, factor_max, frequency_from, frequency_to, resonance, natural_frequency, branches; iso: 0 without K_v, iso_driver, iso_driven: 0
# without sigma_F0, resonance: Hz at which N = 1.
load plots . "/common.gp"
foot_name = "line%d"
lift = room(notes)

array width[2] = [4.4, 1.6]
array level[2] = [iso_driver, iso_driven]
set multiplot title heading offset 0, -0.3
set tics out nomirror font ",14"
set mxtics 5
set lmargin at screen 0.095
set rmargin at screen 0.76
set key at graph 1.01, graph 0.98 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced

set tmargin at screen 0.87 + 0.5 * lift
set bmargin at screen 0.70 + 0.5 * lift
set xrange [path_start - 0.35 : path_end + 0.35]
set yrange [0 : *]
set xlabel "Phase of the pair (mesh periods, 0: pitch point)" offset 0, 0.3
set ylabel "Root stress (MPa)"
set label 1 "{/:Bold (a)} while a tooth passes through the mesh, at rest" at graph 0, graph 1 offset 0, 0.8 font ",14"
n = 1
do for [x in sprintf("%.6f %.6f %.6f %.6f", path_start, path_end - 1, path_start + 1, path_end)] {
  set arrow n from real(x), graph 0 to real(x), graph 1 nohead back lw 1.4 dt (8, 6) lc rgb "#9a9a9a"
  n = n + 1
}
drawn = ''
do for [g = 1:2] {
  drawn = drawn . sprintf('tsv index "[cycle %d]" using 1:2 with lines lt 1 lw %g lc rgb "%s" title word(labels, %d), ', g, width[g], colour[g], g)
  if (level[g] > 0) { drawn = drawn . sprintf('%g with lines lt 1 lw %g dt (18, 8) lc rgb "%s" title "ISO 6336-3: %.0f MPa", ', level[g], 0.5 * width[g], colour[g], level[g]) }
}
eval("plot " . drawn)

span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
set xlabel speed_label offset 0, 0.3
unset arrow
if (natural_frequency > frequency_from && natural_frequency < frequency_to) {
  set arrow from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.2 dt (18, 10)
  set label 11 "f_n" at natural_frequency, graph 0.92 offset 0.5, 0 left tc rgb "#505050" font ",14"
}
set tmargin at screen 0.57 + 0.5 * lift
set bmargin at screen 0.40 + 0.5 * lift
set yrange [0 : 1.08 * stress_max]
set label 1 "{/:Bold (b)} largest over the mesh cycle, sustained for 1/64 of it"
drawn = ''
do for [g = 1:2] {
  drawn = drawn . sprintf('tsv index "[speed down]" using 1:%d with lines lt 1 lw %g dt (10, 5) lc rgb "%s" notitle, ', g + 1, width[g], colour[g]) \
    . sprintf('tsv index "[speed up]" using 1:%d with lines lt 1 lw %g lc rgb "%s" title word(labels, %d), ', g + 1, width[g], colour[g], g)
}
# Orbits of the branch: stable ones, which a sweep may pass by, and unstable ones.
if (branches > 0) {
  do for [g = 1:2] { drawn = drawn . sprintf('tsv index "[branch]" using 1:($8 == 1 ? column(%d) : NaN) with lines lt 1 lw 0.8 lc rgb "%s" notitle, ', g + 1, colour[g]) }
  do for [g = 1:2] { drawn = drawn . sprintf('tsv index "[branch]" using 1:($8 == 0 ? column(%d) : NaN) with lines lt 1 lw %g dt (2, 4) lc rgb "%s" notitle, ', g + 1, width[g], colour[g]) }
  drawn = drawn . 'keyentry with lines lt 1 lw 2.6 dt (2, 4) lc rgb "#505050" title "dots: unstable orbits", '
}
eval("plot " . drawn . 'keyentry with lines lt 1 lw 2.6 dt (10, 5) lc rgb "#505050" title "dashed: falling"')

set tmargin at screen 0.27 + 0.5 * lift
set bmargin at screen 0.082 + 0.8 * lift
set yrange [0 : 1.08 * factor_max]
set ylabel "Dynamic factor (1)"
unset label 11
set label 1 "{/:Bold (c)} the same over the largest at rest; root stress is quasi-static in the tooth loads"
if (iso == 1 && resonance > frequency_from && resonance < frequency_to) {
  set arrow from resonance, graph 0 to resonance, graph 1 nohead back lt 1 lw 1.6 lc rgb "#cc79a7"
}
array what[4] = ["mesh force (over T / r_b)", "tooth load", "root stress, " . word(labels, 1), "root stress, " . word(labels, 2)]
array shade[4] = ["#444444", "#009e73", "#0072b2", "#d55e00"]
array heavy[4] = [2.2, 2.2, 4.4, 1.6]
drawn = ''
do for [k = 1:4] {
  drawn = drawn . sprintf('tsv index "[speed down]" using 1:%d with lines lt 1 lw %g dt (10, 5) lc rgb "%s" notitle, ', k + 3, heavy[k], shade[k]) \
    . sprintf('tsv index "[speed up]" using 1:%d with lines lt 1 lw %g lc rgb "%s" title what[%d], ', k + 3, heavy[k], shade[k], k)
}
if (branches > 0) {
  do for [k = 1:4] { drawn = drawn . sprintf('tsv index "[branch]" using 1:($8 == 1 ? column(%d) : NaN) with lines lt 1 lw 0.8 lc rgb "%s" notitle, ', k + 3, shade[k]) }
  do for [k = 1:4] { drawn = drawn . sprintf('tsv index "[branch]" using 1:($8 == 0 ? column(%d) : NaN) with lines lt 1 lw %g dt (2, 4) lc rgb "%s" notitle, ', k + 3, heavy[k], shade[k]) }
}
if (iso == 1) { drawn = drawn . 'tsv index "[iso]" using 1:2 with lines lt 1 lw 2.2 dt (4, 4) lc rgb "#cc79a7" title "K_v, ISO 6336-1 method B", ' }
# in the key: beside the line a curve would cross the words
if (iso == 1 && resonance > frequency_from && resonance < frequency_to) {
  drawn = drawn . sprintf('keyentry with lines lt 1 lw 1.6 lc rgb "#cc79a7" title "upright: N = 1 (ISO), %.0f %s", ', resonance, speed_scale == 1.0 ? "Hz" : "rpm")
}
eval("plot " . drawn)
eval(below)
unset multiplot
