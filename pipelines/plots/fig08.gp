# Oscillating dynamic transmission error over time (above) and its spectrum (below), a column for each motion at one speed
# (Figures 8 and 9).
# Variables from gear-plot: tsv, title, lines, line1.., motions, height, time_end, largest, largest_amplitude, frequency_end, and for each
# motion a, b, ..: title_a, result_a.
load plots . "/common.gp"

line = "#0072b2"
letters = "a b c d e f"
foot_name = "line%d"
lift = room(lines)
set multiplot title title offset 0, -0.3
unset key
left = 0.075
right = 0.985
gap = 0.06
width = (right - left - (motions - 1) * gap) / motions
set label 20 "Oscillating DTE (µm)" at screen 0.016, screen 0.62 + lift rotate by 90 center
set label 21 "Amplitude (µm)" at screen 0.016, screen 0.25 + lift rotate by 90 center
do for [m = 1:motions] {
  letter = word(letters, m)
  x0 = left + (m - 1) * (width + gap)
  set lmargin at screen x0
  set rmargin at screen x0 + width
  head = value("title_" . letter)
  cut = strstrt(head, ", ")
  found = value("result_" . letter)
  half = strstrt(found, "; ")
  second = strstrt(found, ", ")
  set label 1 "{/:Bold (" . letter . ")} " . head[1:cut] . "\n" . head[cut + 2:*] at graph 0, graph 1 offset 0, 2.2 font ",13"
  set label 2 found[1:second] . "\n" . found[second + 2:half - 1] . "\n" . found[half + 2:*] at graph 0.98, graph 0.97 right font ",13" tc rgb "#303030"
  set tmargin at screen 1 - 128.0 / height
  set bmargin at screen 0.485 + lift
  set xlabel "Time (ms)"
  set xrange [0:time_end]
  set yrange [-1.06 * largest : 1.75 * largest]
  set xtics auto
  plot tsv index "[" . letter . " history]" using 1:2 with lines lt 1 lw 2.4 lc rgb line
  do for [n in "1 2 20 21"] { unset label int(n) }
  set tmargin at screen 0.37 + lift
  set bmargin at screen 0.1 + lift
  set xlabel "Frequency (Hz)"
  set xrange [0 : 1.03 * frequency_end]
  set yrange [0 : 1.1 * largest_amplitude]
  plot tsv index "[" . letter . " spectrum]" using 1:2 with impulses lt 1 lw 3 lc rgb line, \
    "" index "[" . letter . " spectrum]" using 1:2 with points pt 7 ps 0.9 lc rgb line
}
eval(below)
unset multiplot
