# RMS of the oscillating (left) and mean (right) transmission error against mesh frequency, both sweep directions, a row for each
# set of choices, a curve for each torque (Figures 14 and 16, and the same of the elastic pair).
# Variables as fig05.gp, and mean_min_a, mean_max_a, loss_captions, loss_caption1..
load plots . "/common.gp"
unset grid

array torque_colour[6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444"]
# P2000's marks of torques, + o square, for falling speed; filled ones, and x for +, for rising speed
array open_mark[6] = [1, 6, 4, 8, 12, 10]
array filled_mark[6] = [2, 7, 5, 9, 13, 11]
open_signs = "+ ○ □ △ ◇ ▽"
filled_signs = "× ● ■ ▲ ◆ ▼"
letters = "a b c d e f g h"
of(name, letter) = value(name . "_" . letter)
larger(a, b) = a > b ? a : b
span = frequency_to - frequency_from
margin = span > 0 ? 0.02 * span : 1.0
raw = (span > 0 ? span : 1.0) / 6
power = 10 ** floor(log10(raw))
set xtics power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1) out nomirror
set xrange [frequency_from - margin : frequency_to + margin]
set xlabel speed_label
set mxtics 5
set ytics out nomirror
set mytics 2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
# Marks of rising and of falling speed stand at speeds of their own, so that both show where the directions agree.
stride = int(ceil(speeds / 45))
stride = stride < 2 && speeds > 25 ? 2 : stride
speed_step = speeds > 1 ? span / (speeds - 1) : 1.0
place(f) = int(floor((f - frequency_from) / (speed_step > 0 ? speed_step : 1.0) + 0.5))
marked(f, falling) = place(f) % (2 * stride) == (falling ? stride : 0)
most = 1
lost = 0
beyond = 0
do for [p = 1:panels] {
  letter = word(letters, p)
  most = int(larger(most, of("curves", letter)))
  lost = lost + of("contact_lost", letter)
  beyond = beyond + of("beyond_backlash", letter)
}
mark_font = most > 3 ? ",12" : ",14"
set label 101 filled_signs[1:2 * most - 1] . " speed rising      " . open_signs[1:2 * most - 1] . " speed falling      dashed: jump; dotted: to the end of the branch; gap: change of branch" \
  . (lost > 0 ? "      ■ below 0: contact lost" : "") at screen 0.5, screen 26 / height center font mark_font
if (beyond > 0) { set label 102 "○ beyond the backlash, where back flanks would touch" at screen 0.5, screen 52 / height center font mark_font }
# Below all panels what they show, where contact is lost.
base = beyond > 0 ? 78 : 52
lines = int(captions + loss_captions)
do for [n = 0:lines] {
  words = n == 0 ? note1 : n <= captions ? value(sprintf("caption%d", n)) : value(sprintf("loss_caption%d", n - int(captions)))
  set label 103 + n words at screen 0.06, screen (base + 24.0 * (lines - n)) / height font ",12"
}
set multiplot title title offset 0, -0.3
foot_height = base - 40 + 24 * (lines + 1)
panel_height = (height - 110 - foot_height) / panels
do for [p = 1:panels] {
  letter = word(letters, p)
  curves = int(of("curves", letter))
  set tmargin at screen (height - 60 - (p - 1) * panel_height - 60) / height
  set bmargin at screen (height - 60 - p * panel_height + 106) / height
  do for [side = 0:1] {
    set lmargin at screen (side == 0 ? 0.075 : 0.565)
    set rmargin at screen (side == 0 ? 0.48 : 0.97)
    set ylabel (side == 0 ? "RMS of oscillating DTE (µm)" : "Mean DTE (µm)")
    unset label 1
    if (side == 0) {
      set label 1 (panels > 1 ? "{/:Bold (" . letter . ")} " : "") . of("above", letter) at graph 0, graph 1 offset 0, 1.55 font ",12"
    }
    unset arrow
    unset label 11
    do for [i = 1:curves] {
      f = value(sprintf("natural_frequency_%s_%d", letter, i))
      if (f > frequency_from && f < frequency_to) {
        set arrow from f, graph 0 to f, graph 1 nohead back lt 1 lc rgb (curves > 1 ? torque_colour[i] : "#9a9a9a") lw 1.2 dt (18, 10)
        if (i == (curves + 1) / 2) { set label 11 "f_n" at f, graph 1.0 offset 0, 0.55 center tc rgb "#505050" font ",14" }
      }
    }
    low = side == 0 ? 0 : of("mean_min", letter)
    high = side == 0 ? of("rms_max", letter) : of("mean_max", letter)
    tall = high > low ? high - low : 1.0
    foot = 0.016
    # The axis of the RMS begins at 0; where contact is lost the marks of it stand in a strip below.
    strip = side == 0 && of("contact_lost", letter) > 0
    room = side == 1 ? 0.05 : strip ? foot * 2 * curves + 0.02 : 0
    if (strip) { set border 2; set xzeroaxis lt 1 lw 1.6 lc rgb "black" } else { set border 3; unset xzeroaxis }
    end = high + (curves > 3 ? 0.6 : 0.36) * tall
    set yrange [low - room * tall : end]
    # From 0: a number below it would stand in the strip and push the name of the axis over the edge.
    step = 10 ** floor(log10(end / 6))
    if (strip) { set ytics 0, step * (end / 6 / step > 5 ? 10 : end / 6 / step > 2 ? 5 : end / 6 / step > 1 ? 2 : 1) out nomirror } else { set ytics autofreq out nomirror }
    if (side == 0 && end >= 1000) { set lmargin at screen 0.086 }
    # Numbers of three digits push the name of the left axis beyond the edge.
    set ylabel offset (side == 1 ? 0 : end >= 100 ? 1.2 : 0), 0
    key_font = side == 0 ? ",11" : ",13"
    set key at graph 0.995, graph 0.99 right top vertical samplen 1.5 spacing 1.1 font key_font noenhanced opaque
    c = side == 0 ? 2 : 3
    before = side == 0 ? 2 : 5
    after = before + 1
    block(i, what) = sprintf('tsv index "[%s %s %s]"', letter, word(of("labels", letter), i), what)
    branch(i, direction) = block(i, direction) . sprintf(' using 1:%d with linespoints lt 1 lw 1.4 pt 7 ps 0.25 lc rgb "%s" notitle, ', c, torque_colour[i]) \
      . block(i, direction) . sprintf(' using 1:(marked($1, %d) ? $%d : NaN) with points lt 1 lw 1.6 pt %d ps %g lc rgb "%s" notitle, ', \
      direction eq "down", c, direction eq "up" ? filled_mark[i] : open_mark[i], direction eq "up" ? 1.2 : 1.5, torque_colour[i])
    bar(i, direction, row) = block(i, direction) . sprintf(' using 1:($4 > 0 ? %g : NaN) with points pt 5 ps 0.5 lc rgb "%s" notitle, ', \
      -foot * (row - 0.2) * tall, torque_colour[i])
    ring(i, direction) = block(i, direction) . sprintf(' using 1:($8 > 0 ? $%d : NaN) with points pt 6 ps 1.2 lw 1.5 lc rgb "#202020" notitle, ', c)
    jump(i, direction) = block(i, "jumps " . direction) . sprintf(' using 1:%d:(0):($%d - $%d) with vectors head filled' \
      . ' size screen 0.008, 24 fixed lt 1 lw 2 dt (14, 8) lc rgb "%s" notitle, ', before, after, before, torque_colour[i]) \
      . block(i, "jumps " . direction) . sprintf(' using 7:%d:($1 - $7):(0) with vectors nohead lt 1 lw 1.4 dt (3, 5) lc rgb "%s" notitle, ', \
      before, torque_colour[i])
    drawn = ''
    do for [i = 1:curves] {
      drawn = drawn . branch(i, "down") . branch(i, "up")
      if (side == 0 && of("contact_lost", letter) > 0) { drawn = drawn . bar(i, "up", 2 * i - 1) . bar(i, "down", 2 * i) }
      if (of("beyond_backlash", letter) > 0) { drawn = drawn . ring(i, "up") . ring(i, "down") }
      if (value(sprintf("jumps_up_%s_%d", letter, i)) > 0) { drawn = drawn . jump(i, "up") }
      if (value(sprintf("jumps_down_%s_%d", letter, i)) > 0) { drawn = drawn . jump(i, "down") }
    }
    do for [i = 1:curves] {
      drawn = drawn . sprintf('keyentry with linespoints lt 1 lw 2 pt %d ps 1.4 lc rgb "%s" title word(%slabels_%s, %d)%s', open_mark[i], \
        torque_colour[i], side == 0 ? "jump_" : "", letter, i, i < curves ? ', ' : '')
    }
    eval("plot " . drawn)
    do for [n = 101:103 + lines] { unset label n }
  }
}
unset multiplot
