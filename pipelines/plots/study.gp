# A study: a row of panels for each response quantity, a column for each key that varies; of a sample the distribution beside them.
# Variables from gear-plot: tsv, heading, subtitle, second_line, height, rows, columns, random, variants, x1.., ticks1.., tick1_1.., own_colour1.., y1.., drawn1_1.., crossed1_1.., correlation1_1..,
# percentile1_1.., colours, colour_label, colour_name1.., colour_rgb1.., colour_mark1..
load plots . "/common.gp"
unset grid
set datafile separator whitespace
# A long subtitle goes on in a second line.
cut = 0
do for [i = 1:strlen(subtitle)] { if (i < 150 && strlen(subtitle) > 150 && subtitle[i:i + 1] eq "; ") { cut = i } }
foot1 = cut > 0 ? subtitle[1:cut] : subtitle
foot2 = cut > 0 ? subtitle[cut + 2:*] : second_line
foot3 = second_line
foot_name = "foot%d"
lift = room(1 + (cut > 0) + (strlen(second_line) > 0))
all = columns + random
left = 0.1
width = (0.985 - left) / all
top = 1 - 82.0 / height
bottom = (colours > 0 ? 110.0 : 75.0) / height + lift
tall = (top - bottom) / rows
# Numbers below an axis have room for six letters each; names have a letter as large as lets them end before the next panel's.
round_step(x) = (power = 10 ** floor(log10(x)), x <= power ? power : x <= 2 * power ? 2 * power : x <= 5 * power ? 5 * power : 10 * power)
most_steps = int((width - 0.03) * 1600 / 56)
array tick_step[int(columns)]
do for [c = 1:int(columns)] {
  tick_step[c] = 0
  do for [r = 1:int(rows)] {
    if (tick_step[c] == 0 && value(sprintf("ticks%d", c)) == 0 && value(sprintf("drawn%d_%d", r, c)) > 0) {
      stats tsv index sprintf("[panel%d_%d]", r, c) using ($1 * value(sprintf("scale%d", c))) nooutput name "shown"
      if (shown_max > shown_min) { tick_step[c] = round_step(1.06 * (shown_max - shown_min) / most_steps) }
    }
  }
}
letters(name) = strstrt(name, "\n") > 0 ? strstrt(name, "\n") - 1 : strlen(name)
fitting(name, pixels, usual) = sprintf(",%.1f", usual * 0.65 * letters(name) > pixels ? pixels / (0.65 * letters(name)) : usual)
set multiplot title heading
set border 3 lw 1.4
set tics out nomirror font ",13"
set grid lt 1 lc rgb "#e4e4e4" lw 1
set key off
do for [r = 1:int(rows)] {
  set tmargin at screen top - (r - 1) * tall - 14.0 / height
  set bmargin at screen top - r * tall + 72.0 / height
  do for [c = 1:int(all)] {
    set lmargin at screen left + (c - 1) * width
    set rmargin at screen left + c * width - 0.03
    if (c == 1) { set ylabel value(sprintf("y%d", r)) font fitting(value(sprintf("y%d", r)), 0.9 * tall * height, 13) offset 0, 0; set format y "%g" } else { unset ylabel; set format y "" }
    set autoscale
    # Above the points room for the correlation; vibration is seen from 0 on.
    from_0 = strstrt(value(sprintf("y%d", r)), "RMS") > 0
    below_points = from_0 ? 0 : 0.06
    set offsets graph 0.03, graph 0.03, graph 0.2, graph below_points
    if (from_0) { set yrange [0 : *] }
    set ytics autofreq
    unset label
    if (c <= columns) {
      set xlabel value(sprintf("x%d", c)) font fitting(value(sprintf("x%d", c)), 0.95 * width * 1600, 14) offset 0, 0.5
      ticks = int(value(sprintf("ticks%d", c)))
      scale = value(sprintf("scale%d", c))
      set format x "%g"
      set xtics autofreq
      set xtics font ",12"
      if (tick_step[c] > 0) { set xtics tick_step[c] }
      if (ticks > 0) { set xtics (""  1); do for [t = 1:ticks] { set xtics add (value(sprintf("tick%d_%d", c, t)) t) } }
      set label 1 value(sprintf("correlation%d_%d", r, c)) at graph 0.97, 0.93 right font ",13" front
      if (value(sprintf("drawn%d_%d", r, c)) > 0) {
        panel = sprintf("[panel%d_%d]", r, c)
        # A cross where the motion did not settle at one of the speeds; plotted only where there is one, lest gnuplot warn of none.
        crosses = value(sprintf("crossed%d_%d", r, c)) > 0 ? ", tsv index panel using ($4 > 0 ? $1 * scale : NaN):2 with points pt 2 ps 1.8 lw 1.8 lc rgb '#c00000'" : ""
        if (random > 0) {
          eval("plot tsv index panel using ($1 * scale):2:5:3 with points pt variable ps (variants < 100 ? 1.0 : rows > 2 ? 0.5 : 0.7) lc rgb variable" . crosses)
        } else {
          grey = value(sprintf("own_colour%d", c)) > 0
          lines = grey ? "with lines lw 1.2 lc rgb '#b0b0b0'" : "with lines lw 1.8 lc rgb variable"
          eval("plot tsv index panel using ($1 * scale):2" . (grey ? " " : ":3 ") . lines . ", tsv index panel using ($1 * scale):2:5:3 with points pt variable ps 1.1 lc rgb variable" . crosses)
        }
      } else {
        set label 2 "none" at graph 0.5, 0.5 center font ",14"
        set xrange [0:1]
        set yrange [0:1]
        plot NaN
      }
    } else {
      set xlabel "share of the variants (%)" font ",14" offset 0, 0.5
      set xtics 0, 25, 100
      set xrange [0:100]
      set offsets 0, 0, graph 0.2, graph below_points
      if (value(sprintf("drawn%d_1", r)) > 0) {
        array share[3] = [5, 50, 95]
        do for [p = 1:3] {
          set label 2 + p sprintf("%d %%: %.4g", share[p], value(sprintf("percentile%d_%d", r, p))) at graph 0.04, 0.93 - 0.11 * (p - 1) left font ",13" front
        }
        plot tsv index sprintf("[spread%d]", r) using 1:2 with lines lw 2 lc rgb "#0072b2", \
          "+" using (share[int($0) + 1]):(value(sprintf("percentile%d_%d", r, int($0) + 1))) every ::0::2 with points pt 7 ps 1 lc rgb "#d55e00"
      } else {
        set yrange [0:1]
        plot NaN
      }
    }
  }
}
if (colours > 0) {
  # The legend below all panels.
  unset label
  unset tics
  unset xlabel
  unset ylabel
  unset border
  unset grid
  set lmargin at screen 0
  set rmargin at screen 1
  set tmargin at screen 1
  set bmargin at screen 0
  set offsets 0, 0, 0, 0
  set xrange [0:1]
  set yrange [0:1]
  set label 1 colour_label . ":" at left, 30.0 / height + lift left font ",14"
  do for [e = 1:int(colours)] {
    at = left + 0.29 + 0.1 * (e - 1)
    set label 10 + e "" at at, 30.0 / height + lift point pt int(value(sprintf("colour_mark%d", e))) ps 1.4 lc rgb int(value(sprintf("colour_rgb%d", e)))
    set label 20 + e value(sprintf("colour_name%d", e)) at at + 0.012, 30.0 / height + lift left font ",14"
  }
  plot NaN
}
eval(below)
unset multiplot
