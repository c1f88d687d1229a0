# Figures 14 and 16: a lumped model's RMS of the oscillating DTE (a) and mean DTE (b) against mesh frequency, one colour per
# torque, both sweep directions.
# Variables from gear-plot: tsv, title, note1, note2, curves, labels, natural_frequency, frequency_from, frequency_to,
# rms_max, mean_max, jumps_up_<i>, jumps_down_<i>.
set datafile separator tab
set datafile commentschars "#"

array colour[6] = ["#1f4e9c", "#c8201e", "#1a7f37", "#8a4fbf", "#b06a00", "#444444"]
torque(i) = word(word(labels, i), 1)

set multiplot layout 1, 2 title title . "\n{/*0.68 " . note1 . "}\n{/*0.68 " . note2 . "}" offset 0, -0.4 \
  margins screen 0.09, 0.97, 0.215, 0.835 spacing screen 0.09
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set tics out nomirror
set xtics 500
set mxtics 5
set mytics 2
margin = 0.02 * (frequency_to - frequency_from)
set xrange [frequency_from - margin : frequency_to + margin]
set arrow from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.4 dt (18, 10)
set label "f_n" at natural_frequency, graph 1.0 offset 0, 0.55 center tc rgb "#505050" font ",15"

# Up: dots on a line; down: open circles around them where both agree. Curves stop at jumps, arrows lead on.
curves_of(column) = sprintf('for [i = 1:curves] tsv index "[".torque(i)." up]" using 1:%d with linespoints lt 1 lw 1.8' \
  . ' pt 7 ps 0.55 lc rgb colour[i] notitle, for [i = 1:curves] tsv index "[".torque(i)." down]" using 1:%d' \
  . ' with linespoints lt 1 lw 1.2 pt 6 ps 1.35 lc rgb colour[i] notitle', column, column)
arrows(i, direction, before) = sprintf(', tsv index "[jumps ".torque(%d)." %s]" using 1:%d:(0):($%d - $%d) with vectors' \
  . ' head filled size screen 0.008, 24 fixed lt 1 lw 2.2 dt %s lc rgb colour[%d] notitle', i, direction, before, before + 1, \
  before, direction eq "up" ? "solid" : "(12, 7)", i)
rms_arrows = ""
mean_arrows = ""
do for [i = 1:curves] {
  do for [direction in "up down"] {
    if (value(sprintf("jumps_%s_%d", direction, i)) > 0) {
      rms_arrows = rms_arrows . arrows(i, direction, 2)
      mean_arrows = mean_arrows . arrows(i, direction, 4)
    }
  }
}

set xlabel "Mesh frequency (Hz)\n{/:Bold (a)}"
set ylabel "RMS of oscillating DTE (µm)"
set yrange [0 : (rms_max > 0 ? rms_max : 1) * 1.08]
set key at screen 0.5, screen 0.012 center bottom vertical maxrows 2 samplen 2.5 spacing 1.2 Left reverse
legend = ""
do for [i = 1:curves] {
  legend = legend . sprintf(', keyentry with linespoints lt 1 lw 1.8 pt 7 ps 0.8 lc rgb colour[%d] title word(labels, %d)." rising"' \
    . ', keyentry with linespoints lt 1 lw 1.2 pt 6 ps 1.35 lc rgb colour[%d] title word(labels, %d)." falling"', i, i, i, i)
}
eval("plot " . curves_of(2) . rms_arrows . legend)

unset key
set xlabel "Mesh frequency (Hz)\n{/:Bold (b)}"
set ylabel "Mean DTE (µm)"
set yrange [0 : mean_max * 1.08]
eval("plot " . curves_of(3) . mean_arrows)
unset multiplot
