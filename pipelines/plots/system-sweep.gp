# A system over its speeds: RMS of the transmission error and time without contact of each mesh, oscillating force on each bearing.
# Variables from gear-plot: tsv, heading, line1.., height, frequency_from, frequency_to, sweeps_up, sweeps_down and, of each row k,
# quantity1.., axis1.., unit1.., labels1.., curves1.., most1..; notes, their number; speed_label, level_label, level_low, level_high.
load plots . "/common.gp"

foot_name = "line%d"
lift = room(notes)

set multiplot title heading offset 0, -0.4
of(i) = colour[(i - 1) % 6 + 1]
# Meshes that are alike lie on each other: dashes let the one below show.
dashes(i) = i > 6 ? "(10, 5)" : i > 4 ? "(4, 8)" : i > 2 ? "(14, 14)" : "solid"
mark(i) = i > 6 ? 4 : 6
row = ((1 - lift) * height - 100) / 3
span = frequency_to - frequency_from
set xrange [frequency_from - 0.01 * span : frequency_to + 0.01 * span]
set lmargin at screen 0.112
set rmargin at screen 0.82
do for [k = 1:3] {
  quantity = value(sprintf("quantity%d", k))
  axis = value(sprintf("axis%d", k))
  unit = value(sprintf("unit%d", k))
  labels = value(sprintf("labels%d", k))
  largest = value(sprintf("most%d", k))
  curves = int(value(sprintf("curves%d", k)))
  thick(i) = 1.6 + 0.7 * (curves - i)
  set tmargin at screen 1 - (112.0 + row * (k - 1)) / height
  set bmargin at screen 1 - (row + 5.0 + row * (k - 1)) / height
  set xlabel speed_label offset 0, 0.3
  in_levels = k == 1 && level_label ne ""
  set ylabel sprintf("%s (%s)", axis, in_levels ? level_label : unit)
  if (in_levels) { set yrange [level_low : level_high] } else { set yrange [0 : largest] }
  set key at graph 1.012, graph 1.02 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced
  drawn = ""
  do for [i = 1:curves] {
    if (sweeps_up) { drawn = drawn . sprintf('tsv index "[%s up]" using 1:%d with lines lt 1 dt %s lw %g lc rgb "%s" notitle, ', \
      quantity, i + 1, dashes(i), thick(i), of(i)) }
    if (sweeps_down) { drawn = drawn . sprintf('tsv index "[%s down]" using 1:%d with points pt %d ps 0.9 lw 1.6 lc rgb "%s" notitle, ', \
      quantity, i + 1, mark(i), of(i)) }
    drawn = drawn . sprintf('keyentry with linespoints lt 1 dt %s lw 1.8 pt %d ps 1.2 lc rgb "%s" title word(labels, %d), ', \
      dashes(i), mark(i), of(i), i)
  }
  eval("plot " . drawn[1:strlen(drawn) - 2])
}
eval(below)
unset multiplot
