# Designs in motion against speed, both directions of the sweeps: RMS of the dynamic transmission error (a), its first harmonic (b),
# the largest tooth load over T / r_b (c); a colour for each design, falling speed dashed.
# Variables from gear-plot: tsv, heading, height, labels, designs, natural_frequency_1..., rms_max, order_max, load_max, frequency_from,
# frequency_to, speed_label, level_label, level_low, level_high, notes, line1...
load plots . "/common.gp"
foot_name = "line%d"
lift = room(notes)

# The second stands on the first, and lets it show where both are alike.
wide(i) = i == 1 ? 4.4 : 2.6
top(y) = 1 - y * (1 - lift)
set multiplot title heading offset 0, -0.4
set lmargin at screen 0.09
set rmargin at screen 0.97
span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set xrange [frequency_from - 0.01 * span : frequency_to + 0.01 * span]
array high[3] = [rms_max, order_max, load_max]
array axis[3] = [level_label eq "" ? "RMS of DTE (µm)" : "RMS of DTE (" . level_label . ")", \
  level_label eq "" ? "Order 1 of DTE (µm)" : "Order 1 of DTE (" . level_label . ")", "Tooth load / (T / r_b)"]
array tops[3] = [designs > 3 ? 0.12 : 0.085, 0.395, 0.7]
array foots[3] = [0.35, 0.655, 0.93]
do for [p = 1:3] {
  set tmargin at screen top(tops[p])
  set bmargin at screen top(foots[p])
  if (level_label ne "" && p < 3) { set yrange [level_low : level_high] } else { set yrange [0 : 1.08 * (high[p] > 0 ? high[p] : 1)] }
  set ylabel axis[p] . sprintf(" {/:Bold (%s)}", word("a b c", p)) font (level_label eq "" ? "" : ",15")
  if (p == 3) { set xlabel speed_label offset 0, 0.3 } else { unset xlabel }
  unset arrow
  unset label
  do for [i = 1:int(designs)] {
    f = value(sprintf("natural_frequency_%d", i))
    if (f > frequency_from && f < frequency_to) {
      set arrow from f, graph 0 to f, graph 1 nohead back lt 1 lc rgb colour[i] lw 1.1 dt (18, 10)
      if (p == 1) { set label 10 + i "f_n" at f, graph 1 offset 0.3, -0.6 left tc rgb colour[i] font ",13" }
    }
  }
  if (p == 1) { set key at graph 1, graph 1.02 right bottom horizontal Left reverse samplen 2.5 font ",15" noenhanced } else { unset key }
  drawn = ''
  do for [i = 1:int(designs)] {
    drawn = drawn . sprintf('tsv index "[%d down]" using 1:%d with lines lt 1 lw %g dt (9, 5) lc rgb "%s" notitle, ', i, p + 1, wide(i), colour[i]) \
      . sprintf('tsv index "[%d up]" using 1:%d with lines lt 1 lw %g lc rgb "%s" title word(labels, %d), ', i, p + 1, wide(i), colour[i], i)
  }
  if (p == 1) { drawn = drawn . 'keyentry with lines lt 1 lw 2.4 dt (9, 5) lc rgb "#505050" title "dashed: speed falling", ' }
  eval("plot " . drawn . "NaN notitle")
}
eval(below)
unset multiplot
