# Waterfall: spectra of the dynamic transmission error stacked by mesh frequency (a), amplitudes of the first orders of the mesh
# frequency (b); below them the same of the other direction, if there are two.
# Variables from gear-plot: tsv, heading, note1, note2, height, rows, directions, orders, largest, natural_frequency, frequency_end,
# frequency_from, frequency_to.
set datafile separator tab
set datafile commentschars "#"

array colour[6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444"]
span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
# The largest amplitude is a quarter of the range high.
unit = largest > 0 ? largest : 1.0
scale = 0.25 * span / unit

set multiplot title heading . "\n{/*0.62 " . note1 . "}\n{/*0.62 " . note2 . "}" offset 0, -0.4
set border 3 lw 1.6
set tics out nomirror
# of a row of panels
tall = (height - 175.0) / rows
letter(n) = word("a b c d", int(n))
do for [r = 1:int(rows)] {
  set tmargin at screen 1 - (175.0 + (r - 1) * tall + (rows > 1 ? 30 : 0)) / height
  set bmargin at screen 1 - (175.0 + r * tall - 115) / height
  set lmargin at screen 0.09
  set rmargin at screen 0.575
  unset key
  unset grid
  unset logscale y
  set format y "%g"
  set xtics autofreq
  set ytics autofreq
  set xlabel "Frequency (kHz) {/:Bold (" . letter(2 * r - 1) . ")}"
  set ylabel "Mesh frequency (Hz)"
  if (rows > 1) {
    set label 2 (word(directions, r) eq "up" ? "speed rising" : "speed falling") at graph 0, graph 1 offset 0, 1.3 left font ",16"
  }
  top = frequency_to + 0.18 * span
  set xrange [0:frequency_end / 1000]
  set yrange [frequency_from - 0.02 * span : top]
  set mxtics 2
  set arrow 1 from natural_frequency / 1000, graph 0 to natural_frequency / 1000, graph 1 nohead back lt 1 lw 1.4 dt (18, 10) lc rgb "#9a9a9a"
  set label 1 "f_n" at natural_frequency / 1000, graph 1 offset 0, 0.5 center tc rgb "#505050" font ",14"
  # Rays of the orders, with their numbers where they leave the picture.
  do for [k = 1:int(orders)] {
    f = k * top < frequency_end ? top : frequency_end / k
    if (f > frequency_from) {
      set arrow 10 + k from k * frequency_from / 1000, frequency_from to k * f / 1000, f nohead back lt 1 lw 1 lc rgb "#e0d3c0"
      set label 10 + k sprintf("%d", k) at k * f / 1000, f offset (f < top ? 0.6 : 0), (f < top ? 0 : 0.5) center tc rgb "#8a6d3b" font ",13"
    }
  }
  set style textbox opaque margins 0.4, 0.4 fc rgb "#ffffff" noborder
  # How high an amplitude stands, as a bar beside the axis.
  bar = 10 ** floor(log10(unit))
  bar = unit / bar >= 5 ? 5 * bar : unit / bar >= 2 ? 2 * bar : bar
  set arrow 30 from graph 0.965, first frequency_from + 0.02 * span to graph 0.965, first frequency_from + 0.02 * span + bar * scale heads size screen 0.004, 90 lt 1 lw 2 lc rgb "#0072b2"
  set label 30 sprintf("%g µm", bar) at graph 0.955, first frequency_from + 0.02 * span + 0.5 * bar * scale right boxed tc rgb "#0072b2" font ",14"
  plot tsv index sprintf("[speeds %s]", word(directions, r)) using (0):1:(frequency_end / 1000):(0) with vectors nohead lt 1 lw 0.6 lc rgb "#dfe4ea" notitle, \
    tsv index sprintf("[spectra %s]", word(directions, r)) using ($2 / 1000):1:(0):($3 * scale) with vectors nohead lt 1 lw 2.2 lc rgb "#0072b2" notitle

  unset arrow
  unset label
  set lmargin at screen 0.675
  set rmargin at screen 0.985
  set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
  set key at graph 1.0, graph 1.0 right top opaque Left reverse samplen 2 spacing 1.1 font ",14"
  set xlabel "Mesh frequency (Hz) {/:Bold (" . letter(2 * r) . ")}"
  set ylabel "Amplitude (µm)"
  set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
  raw = span / 6
  power = 10 ** floor(log10(raw))
  set xtics power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1)
  set mxtics 2
  set logscale y
  set format y "10^{%L}"
  set yrange [1e-4 * unit : 10 * unit]
  plot for [k = 1:int(orders)] tsv index sprintf("[orders %s]", word(directions, r)) using 1:(column(k + 1) > 0 ? column(k + 1) : NaN) with lines lt 1 lw 2 lc rgb colour[k] title sprintf("order %d", k)
  unset label
}
unset multiplot
