# Force of each gear on its bearing against mesh frequency, both sweep directions: RMS of the oscillating part (a), the largest (b).
# Variables from gear-plot: tsv, heading, note1, note2, height, labels, curves, rms_max, force_max, static_force, frequency_from,
# frequency_to, natural_frequency.
load plots . "/common.gp"
lift = room(2)

# The second stands on the first, and lets it show where both are alike.
array width[2] = [4.4, 1.6]
set multiplot title heading offset 0, -0.3
set mxtics 5
set lmargin at screen 0.11
set rmargin at screen 0.76
span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
set xlabel speed_label
array panel_title[2] = ["{/:Bold (a)} RMS of the oscillating part", "{/:Bold (b)} largest force"]
array high[2] = [rms_max, force_max > static_force ? force_max : static_force]
do for [p = 1:2] {
  set tmargin at screen (p == 1 ? 0.83 : 0.40) + lift
  set bmargin at screen (p == 1 ? 0.53 : 0.10) + lift
  # Numbers of six digits push the name of the axis to the edge.
  set ylabel "Force (N)" offset (high[p] >= 1e5 ? 0.5 : 0), 0
  set yrange [0 : 1.08 * (high[p] > 0 ? high[p] : 1)]
  set label 1 panel_title[p] at graph 0, graph 1 offset 0, 0.8 font ",14"
  unset arrow
  unset label 11
  if (natural_frequency > frequency_from && natural_frequency < frequency_to) {
    set arrow from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.2 dt (18, 10)
    set label 11 "f_n" at natural_frequency, graph 0.92 offset 0.5, 0 left tc rgb "#505050" font ",14"
  }
  set key at graph 1.01, graph 0.98 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced
  drawn = ''
  do for [i = 1:curves] {
    drawn = drawn . sprintf('tsv index "[%d down]" using 1:%d with lines lt 1 lw %g dt (10, 5) lc rgb "%s" notitle, ', i, p + 1, width[i], colour[i]) \
      . sprintf('tsv index "[%d up]" using 1:%d with lines lt 1 lw %g lc rgb "%s" notitle, ', i, p + 1, width[i], colour[i]) \
      . sprintf('keyentry with lines lt 1 lw %g lc rgb "%s" title word(labels, %d), ', width[i], colour[i], i)
  }
  if (p == 2) { drawn = drawn . 'static_force with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#009e73" title sprintf("T / r_b = %.0f N", static_force), ' }
  drawn = drawn . 'keyentry with lines lt 1 lw 2.6 dt (10, 5) lc rgb "#505050" title "dashed: falling"'
  eval("plot " . drawn)
}
eval(below)
unset multiplot
