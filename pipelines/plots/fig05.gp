# Frequency response: RMS of the oscillating dynamic transmission error against mesh frequency, both sweep directions, a panel
# for each set of choices, a curve for each torque (Figures 5 and 7).
# Variables from gear-plot: tsv, title, note1, captions, caption1.., panels, frequency_from, frequency_to, height, speeds, and for each panel a, b, ..:
# above_a, curves_a, labels_a, jump_labels_a, rms_max_a, contact_lost_a, beyond_backlash_a, and for each curve
# natural_frequency_a_1, jumps_up_a_1, jumps_down_a_1, and with a branch of orbits stable_a_1, unstable_a_1, folds_a_1: numbers of rows.
load plots . "/common.gp"
unset grid

up_colour = "#0072b2"
down_colour = "#d55e00"
array torque_colour[6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444"]
# the same, lighter: falling speed
array falling_colour[6] = ["#6bb5e3", "#f2a36e", "#66cfae", "#e3b8d2", "#f3cf7a", "#9c9c9c"]
# P2000's marks of torques, + o square, for falling speed; filled ones, and x for +, for rising speed
array open_mark[6] = [1, 6, 4, 8, 12, 10]
array filled_mark[6] = [2, 7, 5, 9, 13, 11]
open_signs = "+ ○ □ △ ◇ ▽"
filled_signs = "× ● ■ ▲ ◆ ▼"
grey = "#9a9a9a"
letters = "a b c d e f g h"
of(name, letter) = value(name . "_" . letter)
of_curve(name, letter, i) = value(sprintf("%s_%s_%d", name, letter, i))
larger(a, b) = a > b ? a : b
sign(x) = x < 0 ? -1 : 1

span = frequency_to - frequency_from
margin = span > 0 ? 0.02 * span : 1.0
raw = (span > 0 ? span : 1.0) / 10
power = 10 ** floor(log10(raw))
set xtics power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1) out nomirror
set xrange [frequency_from - margin : frequency_to + margin]
set xlabel speed_label
set mxtics 5
set ytics out nomirror
set mytics 2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
set lmargin at screen 0.088
set rmargin at screen 0.975
# Marks at every few speeds, dots at all: marks of neighbours would run into each other. Those of rising and of falling speed stand
# at speeds of their own, so that both show where the directions agree.
stride = int(ceil(speeds / 60))
stride = stride < 2 && speeds > 30 ? 2 : stride
speed_step = speeds > 1 ? span / (speeds - 1) : 1.0
place(f) = int(floor((f - frequency_from) / (speed_step > 0 ? speed_step : 1.0) + 0.5))
marked(f, falling) = place(f) % (2 * stride) == (falling ? stride : 0)

# How marks read, below all panels; with one torque the directions have colours, with several the torques.
most = 1
lost = 0
beyond = 0
any_branch = 0
do for [p = 1:panels] {
  letter = word(letters, p)
  most = int(larger(most, of("curves", letter)))
  lost = lost + of("contact_lost", letter)
  beyond = beyond + of("beyond_backlash", letter)
  do for [i = 1:int(of("curves", letter))] { if (exists(sprintf("folds_%s_%d", letter, i))) { any_branch = 1 } }
}
up_tone = most == 1 ? up_colour : "black"
down_tone = most == 1 ? down_colour : "black"
mark_font = most > 3 ? ",12" : ",14"
set label 101 (most == 1 ? "▲" : filled_signs[1:2 * most - 1]) . " speed rising" at screen 0.06, screen 26 / height tc rgb up_tone font mark_font
set label 102 (most == 1 ? "▽" : open_signs[1:2 * most - 1]) . (most == 1 ? " speed falling" : " falling, lighter") at screen 0.205, screen 26 / height tc rgb down_tone font mark_font
set label 103 "dashed: jump; dotted: to the end of the branch; gap: change of branch" at screen 0.37, screen 26 / height tc rgb "black" font mark_font
if (lost > 0) { set label 104 "■ below 0: contact lost" at screen 0.82, screen 26 / height tc rgb "black" font mark_font }
if (any_branch > 0) { set label 105 "thin: stable orbits; short dashes: unstable orbits; ✱ fold" at screen 0.06, screen 52 / height tc rgb "black" font mark_font }
if (beyond > 0) { set label 106 "○ beyond the backlash, where back flanks would touch" at screen 0.54, screen 52 / height tc rgb "black" font mark_font }

# Above a panel its operating point, in one line; below all panels what f_n is, their scenes and choices.
base = any_branch > 0 || beyond > 0 ? 78 : 52
do for [n = 0:int(captions)] {
  words = n == 0 ? note1 : value(sprintf("caption%d", n))
  set label 107 + n words at screen 0.06, screen (base + 24.0 * (captions - n)) / height tc rgb "black" font ",12"
}
set multiplot title title offset 0, -0.3
foot_height = base - 40 + 24 * (captions + 1)
panel_height = (height - 110 - foot_height) / panels
do for [p = 1:panels] {
  letter = word(letters, p)
  curves = int(of("curves", letter))
  set tmargin at screen (height - 60 - (p - 1) * panel_height - 60) / height
  set bmargin at screen (height - 60 - p * panel_height + 106) / height
  peak = of("rms_max", letter)
  top = (peak > 0 ? peak : 1.0) * (curves > 3 ? 1.6 : 1.36)
  # The legend stands above all that is drawn.
  reach = 1.06 * (peak > 0 ? peak : 1.0)
  rows = 2 * curves
  foot = 0.014
  # The axis begins at 0; where contact is lost the marks of it stand in a strip below.
  strip = of("contact_lost", letter) > 0 ? (foot * rows + 0.02) * top : 0
  set yrange [-strip : top]
  if (strip > 0) { set border 0; set xzeroaxis lt 1 lw 1.6 lc rgb "black" } else { set border 3; unset xzeroaxis }
  power = 10 ** floor(log10(top / 6))
  set ytics 0, power * (top / 6 / power > 5 ? 10 : top / 6 / power > 2 ? 5 : top / 6 / power > 1 ? 2 : 1) out nomirror
  set ylabel "RMS of oscillating DTE (µm)"
  set label 1 (panels > 1 ? "{/:Bold (" . letter . ")} " : "") . of("above", letter) at graph 0, graph 1 offset 0, 1.55 font ",12"

  # f_n and its fractions, where superharmonic resonances stand
  unset arrow
  if (strip > 0) { set arrow from graph 0, first 0 to graph 0, graph 1 nohead lw 1.6 lc rgb "black" }
  do for [n = 11:13] { unset label n }
  do for [i = 1:curves] {
    do for [n = 1:3] {
      f = of_curve("natural_frequency", letter, i) / n
      if (f > frequency_from && f < frequency_to) {
        set arrow from f, graph 0 to f, first reach nohead back lt 1 lc rgb (curves > 1 ? torque_colour[i] : grey) lw 1.2 dt (18, 10)
        if (i == (curves + 1) / 2) {
          fraction = n == 1 ? "f_n" : sprintf("f_n/%d", n)
          set label n + 10 fraction at f, first reach offset 0, 0.55 center tc rgb "#505050" font ",14"
        }
      }
    }
  }

  colour(i, direction) = curves > 1 ? (direction eq "down" ? falling_colour[i] : torque_colour[i]) : value(direction . "_colour")
  mark(i, direction) = direction eq "up" ? (curves > 1 ? filled_mark[i] : 9) : (curves > 1 ? open_mark[i] : 10)
  block(i, what) = sprintf('tsv index "[%s %s %s]"', letter, word(of("labels", letter), i), what)
  branch(i, direction) = block(i, direction) . sprintf(' using 1:2 with linespoints lt 1 lw 1.8 pt 7 ps 0.3 lc rgb "%s" notitle, ', colour(i, direction)) \
    . sprintf('"" index "[%s %s %s]" using 1:(marked($1, %d) ? $2 : NaN) with points lt 1 lw 1.8 pt %d ps %g lc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, direction eq "down", mark(i, direction), direction eq "up" ? 1.4 : 1.8, colour(i, direction))
  # Bars along the foot: speeds at which the teeth part during the period.
  bar(i, direction, row) = block(i, direction) . sprintf(' using 1:($4 > 0 ? %g * top : NaN) with points pt 5 ps 0.6 lc rgb "%s" notitle, ', \
    -foot * (row - 0.2), colour(i, direction))
  ring(i, direction) = block(i, direction) . ' using 1:($8 > 0 ? $2 : NaN) with points pt 6 ps 1.3 lw 1.6 lc rgb "#202020" notitle, '
  # Each curve stops at a jump; an arrow leads to the branch on which the sweep goes on. Where the branch
  # was followed past the last speed of the sweep on it, dots lead from there to its end.
  head = 0.02 * top
  jump(i, direction) = block(i, "jumps " . direction) . sprintf(' using 1:2:(0):($3 - $2) with vectors nohead lt 1 lw 2.4 dt (14, 8) lc rgb "%s" notitle, ', colour(i, direction)) \
    . sprintf('"" index "[%s %s jumps %s]" using 7:2:($1 - $7):(0) with vectors nohead lt 1 lw 1.8 dt (3, 5) lc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, colour(i, direction)) \
    . sprintf('"" index "[%s %s jumps %s]" using 1:($3 - head * sign($3 - $2)):(0):(head * sign($3 - $2)) with vectors head filled' \
    . ' size screen 0.008, 24 fixed lt 1 lw 2.4 lc rgb "%s" notitle, ', \
    letter, word(of("labels", letter), i), direction, colour(i, direction))

  # Orbits that no sweep can show, and where they meet the others.
  held(i, what) = exists(sprintf("%s_%s_%d", what, letter, i)) && of_curve(what, letter, i) > 0
  branch_tone(i) = curves > 1 ? torque_colour[i] : "#009e73"
  stays(i) = block(i, "stable") . sprintf(' using 1:2 with lines lt 1 lw 1.4 lc rgb "%s" notitle, ', branch_tone(i))
  orbits(i) = block(i, "unstable") . sprintf(' using 1:2 with lines lt 1 lw 2.2 dt (9, 6) lc rgb "%s" notitle, ', branch_tone(i))
  folds(i) = block(i, "folds") . sprintf(' using 1:2 with points lt 1 lw 2.4 pt 3 ps 2.2 lc rgb "%s" notitle, ', branch_tone(i))

  set key at graph 0.995, graph 0.99 right top vertical samplen 1.5 spacing 1.15 font ",14" noenhanced
  drawn = ''
  do for [i = 1:curves] {
    if (held(i, "stable")) { drawn = drawn . stays(i) }
    drawn = drawn . branch(i, "down") . branch(i, "up")
    if (held(i, "unstable")) { drawn = drawn . orbits(i) }
    if (held(i, "folds")) { drawn = drawn . folds(i) }
    if (of("contact_lost", letter) > 0) { drawn = drawn . bar(i, "up", 2 * i - 1) . bar(i, "down", 2 * i) }
    if (of("beyond_backlash", letter) > 0) { drawn = drawn . ring(i, "up") . ring(i, "down") }
    if (of_curve("jumps_up", letter, i) > 0) { drawn = drawn . jump(i, "up") }
    if (of_curve("jumps_down", letter, i) > 0) { drawn = drawn . jump(i, "down") }
  }
  do for [i = 1:curves] {
    drawn = drawn . sprintf('keyentry with %s title word(jump_labels_%s, %d)%s', curves == 1 ? 'lines lt 1 lw 0 lc rgb "#ffffff"' \
      : sprintf('linespoints lt 1 lw 2 pt %d ps 1.6 lc rgb "%s"', open_mark[i], torque_colour[i]), letter, i, i < curves ? ', ' : '')
  }
  eval("plot " . drawn)
  do for [n = 101:107 + int(captions)] { unset label n }
}
unset multiplot
