# Map of jumps: torque against damping ratio, one panel per corner rule; cells by what happens in them, lines of the largest
# tooth load.
# Variables from gear-plot: tsv, heading, note1.., notes, panels, panel1.., cusps_1.. (rows), printed, lines, largest, ratio_from, ratio_to,
# torque_from, torque_to, first_ratio, last_ratio.
load plots . "/common.gp"
unset grid
set datafile separator whitespace

two_colour = "#e8998d"
lost_colour = "#f6dfa4"
kept_colour = "#e3edf7"
line_colour = colour[1]

# The largest tooth load between the middles of the cells, torque on a logarithmic scale. kN
if (lines > 0) {
  set contour base
  unset surface
  step = largest > 80 ? step_of(largest / 8) : largest > 40 ? 10 : largest > 16 ? 4 : largest > 8 ? 2 : 1
  set cntrparam levels incremental step, step, 100 * step
  set cntrparam linear
  do for [p = 1:int(panels)] {
    eval(sprintf("set table $load%d", p))
    splot tsv index sprintf("[panel%d]", p) using 1:(log10($2)):8
    unset table
  }
  unset contour
  set surface
}

set multiplot title heading offset 0, -0.2
set border 15 lw 1.6 front
set tics out nomirror front
set logscale y
set xrange [ratio_from:ratio_to]
set yrange [torque_from:torque_to]
set xlabel "Damping ratio, two pairs in contact (%)" offset 0, 0.6 font ",15"
set ytics (20, 50, 100, 150, 200, 300, 450, 600, 1000, 2000, 5000)
set style fill solid 1.0 border rgb "#ffffff"
left = 0.085
width = (0.99 - left) / panels
set tmargin at screen 0.875
set bmargin at screen 0.42
class(p, n) = sprintf("tsv index '[panel%d]' using ($7 == %d ? $1 : NaN):2:3:4:5:6 with boxxyerror lc rgb %s notitle", \
  p, n, n == 2 ? "two_colour" : n == 1 ? "lost_colour" : "kept_colour")
do for [p = 1:int(panels)] {
  set lmargin at screen left + (p - 1) * width
  set rmargin at screen left + p * width - 0.015
  set label 1 value(sprintf("panel%d", p)) at graph 0.5, graph 1.045 center
  if (p == 1) { set ylabel "Torque (N m)" offset 1, 0 } else { unset ylabel; set format y "" }
  drawn = class(p, 0) . ", " . class(p, 1) . ", " . class(p, 2)
  if (lines > 0) {
    drawn = drawn . sprintf(", $load%d using 1:(10**$2) with lines lw 2 lc rgb line_colour notitle", p)
    # Labels where the lines end at the first and the last damping ratio: elsewhere they crowd.
    drawn = drawn . sprintf(", $load%d using ($1 < first_ratio + 1e-6 ? $1 : NaN):(10**$2):(sprintf('%%g', $3)) with labels" \
      . " offset 1.1, 0.45 font ',13' tc rgb line_colour notitle", p)
    drawn = drawn . sprintf(", $load%d using ($1 > last_ratio - 1e-6 ? $1 : NaN):(10**$2):(sprintf('%%g', $3)) with labels" \
      . " offset 0.9, 0.45 font ',13' tc rgb line_colour notitle", p)
  }
  # To the left of the cusps there are two branches.
  if (value(sprintf("cusps_%d", p)) > 0) { drawn = drawn . sprintf(", tsv index '[cusps%d]' using 1:2 with linespoints lw 3 pt 6 ps 1.6 lc rgb '#7a1f10' notitle", p) }
  if (printed > 0) { drawn = drawn . ", tsv index '[printed]' using 1:2 with points pt 13 ps 2.2 lc rgb '#000000' notitle" }
  eval("plot " . drawn)
}
# The legend and the answers in words below the panels.
unset label 1
unset logscale
unset tics
unset xlabel
unset ylabel
unset border
set lmargin at screen 0
set rmargin at screen 1
set tmargin at screen 1
set bmargin at screen 0
set xrange [0:1]
set yrange [0:1]
mark(n, colour, words) = sprintf("set object %d rectangle from %g, 0.290 to %g, 0.312 fc rgb '%s' fs solid border rgb '#808080';" \
  . " set label %d '%s' at %g, 0.301 left font ',16'", n, 0.07 + 0.16 * (n - 1), 0.09 + 0.16 * (n - 1), colour, 10 + n, words, 0.097 + 0.16 * (n - 1))
eval(mark(1, kept_colour, "contact kept"))
eval(mark(2, lost_colour, "lost, one branch"))
eval(mark(3, two_colour, "two branches"))
if (lines > 0) {
  set arrow 1 from 0.55, 0.301 to 0.575, 0.301 nohead lw 2 lc rgb line_colour
  set label 14 "largest tooth load, kN" at 0.582, 0.301 left font ",16"
}
if (value("cusps_1") > 0) { set label 17 "" at 0.075, 0.325 point pt 6 ps 1.6 lw 3 lc rgb "#7a1f10"; set label 18 "cusp of the folds: two branches to the left" at 0.097, 0.325 left font ",16" }
if (printed > 0) {
  set label 15 "" at 0.785, 0.301 point pt 13 ps 2.2 lc rgb "#000000"
  set label 16 printed_label at 0.797, 0.301 left font ",16"
}
do for [n = 1:int(notes)] { set label 20 + n value(sprintf("note%d", n)) at 0.02, 0.258 - 0.0285 * (n - 1) left noenhanced font ",12" }
plot NaN notitle
unset multiplot
