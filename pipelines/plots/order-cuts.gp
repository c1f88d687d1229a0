# Order cuts: amplitudes of the first orders of the transmission error against speed, rising (a) and falling (b); the speed of the
# driver above, or the mesh frequency where the speed is below.
# Variables from gear-plot: tsv, heading, height, driver, orders, largest, frequency_from, frequency_to, natural_frequency,
# rpm_per_hertz, speed_label, speed_scale, level_label, level_low, level_high, note1, note2.
load plots . "/common.gp"
lift = room(2)

array dash[6] = [1, 1, 2, 4, 5, 3]
top(y) = 1 - y * (1 - lift)
set multiplot title heading offset 0, -0.4
set border 7 lw 1.6
set lmargin at screen 0.09
set rmargin at screen 0.86
span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set xrange [frequency_from : frequency_from + span]
in_hertz = speed_scale == 1
other = in_hertz ? rpm_per_hertz : 1 / speed_scale
set x2range [frequency_from * other : (frequency_from + span) * other]
set key at graph 1.02, graph 1 left top Left reverse samplen 2 spacing 1.2 font ",15"
unit = largest > 0 ? largest : 1.0
if (level_label eq "") {
  set logscale y
  set format y "10^{%L}"
  set yrange [1e-4 * unit : 3 * unit]
} else { set yrange [level_low : level_high] }
array way[2] = ["up", "down"]
array heads[2] = ["{/:Bold (a)} speed rising", "{/:Bold (b)} speed falling"]
do for [p = 1:2] {
  set tmargin at screen top(p == 1 ? 0.17 : 0.58)
  set bmargin at screen top(p == 1 ? 0.5 : 0.91)
  if (p == 1) {
    set x2tics out
    set x2label (in_hertz ? "Speed of " . driver . " (rpm)" : "Mesh frequency (Hz)") offset 0, 0.2
    unset xlabel
  } else {
    unset x2tics
    unset x2label
    set border 3
    set xlabel speed_label offset 0, 0.3
  }
  set ylabel (level_label eq "" ? "Amplitude of DTE (µm)" : "DTE (" . level_label . ")")
  set label 1 heads[p] at graph 0.01, graph 1 offset 0, -0.9 left front font ",16"
  if (natural_frequency > frequency_from && natural_frequency < frequency_to) {
    set arrow 1 from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.2 dt (18, 10)
    set label 2 "f_n" at natural_frequency, graph 0 offset 0.4, 0.7 left tc rgb "#505050" font ",14"
  }
  plot for [k = 1:int(orders)] tsv index "[orders " . way[p] . "]" using 1:(column(k + 1)) with lines lt 1 lw (k == 1 ? 2.8 : 2.0) dt dash[k] lc rgb colour[k] title sprintf("order %d", k)
}
eval(below)
unset multiplot
