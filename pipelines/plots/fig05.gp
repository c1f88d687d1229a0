# Frequency response: RMS of the oscillating dynamic transmission error against mesh frequency, both sweep directions, a panel
# for each set of choices, a curve for each torque (Figures 5 and 7).
# Variables from gear-plot: tsv, title, note1, panels, frequency_from, frequency_to, height, and for each panel a, b, ..:
# choices_a, curves_a, labels_a, jump_labels_a, rms_max_a, contact_lost_a, and for each curve natural_frequency_a_1,
# jumps_up_a_1, jumps_down_a_1.
set datafile separator tab
set datafile commentschars "#"

up_colour = "#1f4e9c"
down_colour = "#c8201e"
array torque_colour[6] = ["#1f4e9c", "#c8201e", "#1a7f37", "#8a4fbf", "#b06a00", "#444444"]
grey = "#9a9a9a"
letters = "a b c d e f g h"
of(name, letter) = value(name . "_" . letter)
of_curve(name, letter, i) = value(sprintf("%s_%s_%d", name, letter, i))

span = frequency_to - frequency_from
margin = span > 0 ? 0.02 * span : 1.0
set xrange [frequency_from - margin : frequency_to + margin]
set xlabel "Mesh frequency (Hz)"
set xtics out nomirror
set mxtics 5
set ytics out nomirror
set mytics 2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set lmargin at screen 0.088
set rmargin at screen 0.975
larger(a, b) = a > b ? a : b
sign(x) = x < 0 ? -1 : 1

# How marks read, below all panels; with one torque the directions have colours, with several the torques.
one = 1
do for [p = 1:panels] { if (of("curves", word(letters, p)) > 1) { one = 0 } }
up_tone = one ? up_colour : "black"
down_tone = one ? down_colour : "black"
lost = 0
do for [p = 1:panels] { lost = lost + of("contact_lost", word(letters, p)) }
set label 101 "▲ speed rising" at screen 0.06, screen 26 / height tc rgb up_tone
set label 102 "▽ speed falling" at screen 0.205, screen 26 / height tc rgb down_tone
set label 103 "dashed: jump; dots: on to the end of the branch" at screen 0.37, screen 26 / height tc rgb "black"
if (lost > 0) { set label 104 "■ at the foot: contact is lost" at screen 0.752, screen 26 / height tc rgb "black" }

set multiplot title title . "\n{/*0.68 " . note1 . "}" offset 0, -0.3
panel_height = (height - 140) / panels
do for [p = 1:panels] {
  letter = word(letters, p)
  curves = int(of("curves", letter))
  set tmargin at screen (height - 90 - (p - 1) * panel_height - 75) / height
  set bmargin at screen (height - 90 - p * panel_height + 120) / height
  peak = of("rms_max", letter)
  top = (peak > 0 ? peak : 1.0) * 1.36
  rows = 2 * curves
  foot = 0.014
  set yrange [-(foot * rows + 0.02) * top : top]
  set ylabel "RMS of oscillating DTE (µm)"
  set label 1 "{/:Bold (" . letter . ")} " . of("choices", letter) at graph 0, graph 1 offset 0, 2.0 font ",14"

  # f_n and its fractions, where superharmonic resonances stand
  unset arrow
  do for [i = 1:curves] {
    do for [n = 1:3] {
      f = of_curve("natural_frequency", letter, i) / n
      if (f > frequency_from && f < frequency_to) {
        set arrow from f, graph 0 to f, graph 1 nohead back lt 1 lc rgb (curves > 1 ? torque_colour[i] : grey) lw 1.2 dt (18, 10)
        if (i == (curves + 1) / 2) {
          fraction = n == 1 ? "f_n" : sprintf("f_n/%d", n)
          set label n + 10 fraction at f, graph 1.0 offset 0, 0.55 center tc rgb "#505050" font ",15"
        }
      }
    }
  }

  colour(i, direction) = curves > 1 ? torque_colour[i] : value(direction . "_colour")
  block(i, what) = sprintf('tsv index "[%s %s %s]"', letter, word(of("labels", letter), i), what)
  # Where the directions agree the filled triangle stands inside the open one.
  branch(i, direction, mark) = block(i, direction) . sprintf(' using 1:2 with linespoints lt 1 lw 1.8 %s lc rgb "%s" notitle, ', \
    mark, colour(i, direction))
  # Bars along the foot: speeds at which the teeth part during the period.
  bar(i, direction, row) = block(i, direction) . sprintf(' using 1:($4 > 0 ? %g * top : NaN) with points pt 5 ps 0.6 lc rgb "%s" notitle, ', \
    -foot * (row - 0.2), colour(i, direction))
  # Each curve stops at a jump; an arrow leads to the branch on which the march goes on. Where the branch
  # was followed past the last speed of the sweep on it, dots lead from there to its end.
  head = 0.02 * top
  jump(i, direction) = block(i, "jumps " . direction) . sprintf(' using 1:2:(0):($3 - $2) with vectors nohead lt 1 lw 2.4 dt (14, 8) lc rgb "%s" notitle, ', colour(i, direction)) \
    . sprintf('"" index "[%s %s jumps %s]" using 8:2:($1 - $8):(0) with vectors nohead lt 1 lw 1.8 dt (3, 5) lc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, colour(i, direction)) \
    . sprintf('"" index "[%s %s jumps %s]" using 1:($3 - head * sign($3 - $2)):(0):(head * sign($3 - $2)) with vectors head filled' \
    . ' size screen 0.008, 24 fixed lt 1 lw 2.4 lc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, colour(i, direction))
  # With one torque the frequency stands on a leader up to the top, those of neighbours in several rows.
  label_y(row) = top * (0.99 - (panels > 1 ? 0.26 : 0.20) * row)
  named(i, direction, shift) = sprintf('"" index "[%s %s jumps %s]" using 1:(larger($2, $3)):(0):(label_y($5) - larger($2, $3))' \
    . ' with vectors nohead lt 1 lw 1.2 dt (6, 8) lc rgb "%s" notitle, "" index "[%s %s jumps %s]"' \
    . ' using 1:(label_y($5)):(sprintf("jump %%.0f Hz", $1)) with labels rotate by 90 right offset %s font ",15" tc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, colour(i, direction), \
    letter, word(of("labels", letter), i), direction, shift, colour(i, direction))

  set key at graph 0.995, graph 0.99 right top vertical samplen 1.5 spacing 1.15 font ",14" noenhanced opaque
  if (curves == 1) { unset key }
  drawn = ''
  do for [i = 1:curves] {
    drawn = drawn . branch(i, "down", "pt 10 ps 2.1") . branch(i, "up", "pt 9 ps 1.25")
    if (of("contact_lost", letter) > 0) { drawn = drawn . bar(i, "up", 2 * i - 1) . bar(i, "down", 2 * i) }
    if (of_curve("jumps_up", letter, i) > 0) {
      drawn = drawn . jump(i, "up")
      if (curves == 1) { drawn = drawn . named(i, "up", "char 0.9, 0") }
    }
    if (of_curve("jumps_down", letter, i) > 0) {
      drawn = drawn . jump(i, "down")
      if (curves == 1) { drawn = drawn . named(i, "down", "char -0.7, 0") }
    }
  }
  do for [i = 1:curves] {
    drawn = drawn . sprintf('keyentry with lines lt 1 lw 3 lc rgb "%s" title word(jump_labels_%s, %d)%s', torque_colour[i], letter, i, i < curves ? ', ' : '')
  }
  eval("plot " . drawn)
}
unset multiplot
