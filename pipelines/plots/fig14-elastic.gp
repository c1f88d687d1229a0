# RMS of the oscillating (left) and mean (right) dynamic transmission error against mesh frequency: what Figure 14 shows of the
# lumped model. Variables as fig05.gp, and mean_min_a, mean_max_a.
set datafile separator tab
set datafile commentschars "#"

array torque_colour[6] = ["#1f4e9c", "#c8201e", "#1a7f37", "#8a4fbf", "#b06a00", "#444444"]
letters = "a b c d e f g h"
of(name, letter) = value(name . "_" . letter)
span = frequency_to - frequency_from
margin = span > 0 ? 0.02 * span : 1.0
set xrange [frequency_from - margin : frequency_to + margin]
set xlabel "Mesh frequency (Hz)"
set xtics 1000 out nomirror
set mxtics 5
set ytics out nomirror
set mytics 2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set label 101 "▲ speed rising      ▽ speed falling      dashed: jump; dots: on to the end of the branch" at screen 0.5, screen 26 / height center
set multiplot title title . "\n{/*0.68 " . note1 . "}" offset 0, -0.3
panel_height = (height - 140) / panels
do for [p = 1:panels] {
  letter = word(letters, p)
  curves = int(of("curves", letter))
  set tmargin at screen (height - 90 - (p - 1) * panel_height - 60) / height
  set bmargin at screen (height - 90 - p * panel_height + 120) / height
  do for [side = 0:1] {
    set lmargin at screen (side == 0 ? 0.075 : 0.575)
    set rmargin at screen (side == 0 ? 0.485 : 0.985)
    set ylabel (side == 0 ? "RMS of oscillating DTE (µm)" : "Mean DTE (µm)")
    unset label 1
    if (side == 0) { set label 1 "{/:Bold (" . letter . ")} " . of("choices", letter) at graph 0, graph 1 offset 0, 1.2 font ",14" }
    low = side == 0 ? 0 : of("mean_min", letter)
    high = side == 0 ? of("rms_max", letter) : of("mean_max", letter)
    set yrange [low - 0.05 * (high - low) : high + 0.28 * (high - low)]
    set key at graph 0.995, graph 0.99 right top vertical samplen 1.5 spacing 1.15 font ",14" opaque
    c = side == 0 ? 2 : 3
    before = side == 0 ? 2 : 6
    after = side == 0 ? 3 : 7
    block(i, what) = sprintf('tsv index "[%s %s %s]"', letter, word(of("labels", letter), i), what)
    branch(i, direction, mark) = block(i, direction) . sprintf(' using 1:%d with linespoints lt 1 lw 1.4 %s lc rgb "%s" notitle, ', \
      c, mark, torque_colour[i])
    jump(i, direction) = block(i, "jumps " . direction) . sprintf(' using 1:%d:(0):($%d - $%d) with vectors head filled' \
      . ' size screen 0.008, 24 fixed lt 1 lw 2 dt (14, 8) lc rgb "%s" notitle, ', before, after, before, torque_colour[i]) \
      . block(i, "jumps " . direction) . sprintf(' using 8:%d:($1 - $8):(0) with vectors nohead lt 1 lw 1.4 dt (3, 5) lc rgb "%s" notitle, ', \
      before, torque_colour[i])
    drawn = ''
    do for [i = 1:curves] {
      drawn = drawn . branch(i, "down", "pt 10 ps 1.5") . branch(i, "up", "pt 9 ps 0.9")
      if (value(sprintf("jumps_up_%s_%d", letter, i)) > 0) { drawn = drawn . jump(i, "up") }
      if (value(sprintf("jumps_down_%s_%d", letter, i)) > 0) { drawn = drawn . jump(i, "down") }
    }
    do for [i = 1:curves] {
      drawn = drawn . sprintf('keyentry with lines lt 1 lw 3 lc rgb "%s" title word(labels_%s, %d)%s', torque_colour[i], letter, i, i < curves ? ', ' : '')
    }
    eval("plot " . drawn)
  }
}
unset multiplot
