# Waterfall: spectra of the dynamic transmission error against mesh frequency as colours (a), amplitudes of the first orders of the mesh
# frequency (b); below them the same of the other direction, if there are two.
# Variables from gear-plot: tsv, heading, note1, note2, height, rows, directions, orders, largest, speed_step, natural_frequency, frequency_end,
# frequency_from, frequency_to.
load plots . "/common.gp"
unset grid
lift = room(2)

span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
unit = largest > 0 ? largest : 1.0
# An amplitude is a bar at its frequency, as tall as the step of the speeds, its colour the amplitude over three decades.
low = log10(unit) - 3
half_tall = 0.5 * (speed_step > 0 ? speed_step : span)
# As wide as its order moves with a step, so that a ray is a band.
half_wide(order) = order * half_tall / speed_scale > 0.004 * frequency_end ? order * half_tall / speed_scale : 0.004 * frequency_end
eval(of_areas)

set multiplot title heading offset 0, -0.4
# of a row of panels
tall = (height - 175.0) / rows
do for [r = 1:int(rows)] {
  set tmargin at screen (1 - (175.0 + (r - 1) * tall + (rows > 1 ? 30 : 0)) / height) + lift
  set bmargin at screen 1 - (175.0 + r * tall - 115) / height + lift
  set lmargin at screen 0.09
  set rmargin at screen 0.5
  unset key
  unset grid
  unset logscale y
  set format y "%g"
  set xtics step_of(frequency_end / 6)
  set ytics autofreq
  set xlabel "Frequency (Hz) {/:Bold (" . letter(2 * r - 1) . ")}"
  set ylabel speed_label
  if (rows > 1) {
    set label 2 (word(directions, r) eq "up" ? "speed rising" : "speed falling") at graph 0, graph 1 offset 0, 1.3 left font ",16"
  }
  top = frequency_to + 0.18 * span
  set xrange [0:frequency_end]
  set yrange [frequency_from - 0.02 * span : top]
  set mxtics 2
  set arrow 1 from natural_frequency / speed_scale, graph 0 to natural_frequency / speed_scale, graph 1 nohead back lt 1 lw 1.4 dt (18, 10) lc rgb "#9a9a9a"
  set label 1 "f_n" at natural_frequency / speed_scale, graph 1 offset 0, 0.5 center tc rgb "#505050" font ",14"
  # Rays of the orders, with their numbers where they leave the picture.
  do for [k = 1:int(orders)] {
    hertz(speed) = speed / speed_scale
    f = k * hertz(top) < frequency_end ? top : frequency_end * speed_scale / k
    if (f > frequency_from) {
      set arrow 10 + k from k * hertz(frequency_from), frequency_from to k * hertz(f), f nohead back lt 1 lw 1 dt (4, 6) lc rgb "#b0a48c"
      set label 10 + k sprintf("%d", k) at k * hertz(f), f offset (f < top ? 0.6 : 0), (f < top ? 0 : 0.5) center tc rgb "#8a6d3b" font ",13"
    }
  }
  set cbrange [low : log10(unit)]
  # Ticks in micrometres on an axis of powers of ten.
  set cbtics ("" low)
  do for [t = int(ceil(low)):int(floor(log10(unit)))] { set cbtics add (sprintf("%g", 10.0 ** t) t) }
  set cblabel "Amplitude (µm)" offset 0.3
  x0 = 0.515
  foot = 1 - (175.0 + r * tall - 115) / height
  set colorbox user origin screen x0, foot + lift size screen 0.012, (tall - 115.0 - (rows > 1 ? 30 : 0)) / height
  plot tsv index sprintf("[spectra %s]", word(directions, r)) using 2:1:(half_wide($2 / $1 * speed_scale)):(half_tall):(log10($3) > low ? log10($3) : NaN) \
    with boxxyerror fs solid 1 noborder lc palette notitle
  unset colorbox

  unset arrow
  unset label
  set lmargin at screen 0.675
  set rmargin at screen 0.965
  set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
  set key at graph 1.0, graph 1.0 right top opaque Left reverse samplen 2 spacing 1.1 font ",14"
  set xlabel speed_label . " {/:Bold (" . letter(2 * r) . ")}"
  set ylabel "Amplitude (µm)"
  set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
  set xtics step_of(span / 6)
  set mxtics 2
  set logscale y
  set format y "10^{%L}"
  set yrange [1e-4 * unit : 10 * unit]
  plot for [k = 1:int(orders)] tsv index sprintf("[orders %s]", word(directions, r)) using 1:(column(k + 1) > 0 ? column(k + 1) : NaN) with lines lt 1 lw 2 lc rgb colour[k] title sprintf("order %d", k)
  unset label
}
eval(below)
unset multiplot
