# Map of jumps of lumped models: torque against damping ratio, a column per model, below it the same with the damper in contact
# only; cells by what happens in them. The elastic pair stands first.
# Variables from gear-plot: tsv, heading, note1.., notes, panels, panel1.., column1.., row1.., columns, marked, ratio_from, ratio_to,
# torque_from, torque_to.
load plots . "/common.gp"
unset grid
set datafile separator whitespace

two_colour = "#e8998d"
lost_colour = "#f6dfa4"
kept_colour = "#e3edf7"

set multiplot title heading offset 0, -0.2
set border 15 lw 1.6 front
set tics out nomirror front
set logscale y
set xrange [ratio_from:ratio_to]
set yrange [torque_from:torque_to]
set xtics 2 font ",13" offset 0, 0.5
set ytics font ",13"
set ytics (20, 50, 100, 150, 200, 300, 450, 600, 1000, 2000, 5000)
set style fill solid 1.0 border rgb "#ffffff"
left = torque_to < 1000 ? 0.07 : 0.085  # room for the numbers of torques
width = (0.995 - left) / columns
class(p, n) = sprintf("tsv index '[panel%d]' using ($7 == %d ? $1 : NaN):2:3:4:5:6 with boxxyerror lc rgb %s notitle", \
  p, n, n == 2 ? "two_colour" : n == 1 ? "lost_colour" : "kept_colour")
do for [p = 1:int(panels)] {
  column = value(sprintf("column%d", p))
  row = value(sprintf("row%d", p))
  set lmargin at screen left + column * width
  set rmargin at screen left + (column + 1) * width - 0.012
  set tmargin at screen 0.905 - row * 0.29
  set bmargin at screen 0.705 - row * 0.29
  set label 1 value(sprintf("panel%d", p)) at graph 0.5, graph 1.06 center font (row > 0 ? ",12" : ",14")
  set arrow 1 from marked, graph 0 to marked, graph 1 nohead dt 2 lw 1.5 lc rgb "#606060" front
  # Numbers of torques where nothing stands to the left of a panel.
  bare = column == 0 || (row == 1 && column == 1)
  if (bare) { set ylabel "Torque (N m)" offset 0, 0 font ",14"; set format y "%g" } else { unset ylabel; set format y "" }
  set xlabel "Damping ratio (%)" offset 0, 1.3 font ",14"
  eval("plot " . class(p, 0) . ", " . class(p, 1) . ", " . class(p, 2))
}
# The legend and the answers in words below the panels.
unset label 1
unset arrow 1
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
mark(n, colour, words) = sprintf("set object %d rectangle from %g, 0.345 to %g, 0.361 fc rgb '%s' fs solid border rgb '#808080';" \
  . " set label %d '%s' at %g, 0.353 left font ',15'", n, 0.07 + 0.16 * (n - 1), 0.09 + 0.16 * (n - 1), colour, 10 + n, words, 0.097 + 0.16 * (n - 1))
eval(mark(1, kept_colour, "contact kept"))
eval(mark(2, lost_colour, "lost, one branch"))
eval(mark(3, two_colour, "two branches"))
do for [n = 1:int(notes)] { set label 20 + n value(sprintf("note%d", n)) at 0.02, 0.322 - 0.0205 * (n - 1) left noenhanced font ",11" }
plot NaN notitle
unset multiplot
