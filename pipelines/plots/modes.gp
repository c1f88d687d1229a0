# Natural modes of a system: frequencies by type (above), and mode shapes, magnified (below); grey: at rest.
# Variables from gear-plot: tsv, heading, panels, columns, lines, highest, left, right, low, high (mm), train (1: types are not those
# of a planetary train), mixed (1: there are such modes), panel1.., note1.., height.
load plots . "/common.gp"
unset grid
lift = room(3)

set multiplot title heading offset 0, -0.2
set border 1 lw 1.6
unset key
set lmargin at screen 0.13
set rmargin at screen 0.98
set tmargin at screen 1 - 110.0 / height
set bmargin at screen 1 - 270.0 / height
set xrange [0 : 1.04 * highest]
set xlabel "Natural frequency (Hz)" offset 0, 0.3
if (train == 1) {
  set yrange [3.5 : 4.6]
  set ytics ("modes" 4)
} else {
  set yrange [mixed == 1 ? 3.6 : 2.6 : -0.7]
  set ytics ("rotational" 0, "translational" 1, "planet" 2)
  if (mixed == 1) { set ytics add ("mixed" 3) }
}
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
array colours[5] = ["#0072b2", "#d55e00", "#009e73", "#555555", "#0072b2"]
plot for [k = 0:4] tsv index "[frequencies]" using ($3 == k ? $2 : NaN):3 with points pt 7 ps 1.3 lc rgb colours[k + 1]

unset colorbox
unset grid
unset border
unset tics
unset xlabel
set size ratio -1
set xrange [left : right]
set yrange [low : high]
band = 340.0 / height
do for [n = 1:int(panels)] {
  column = (n - 1) % int(columns)
  line = (n - 1) / int(columns)
  set lmargin at screen 0.012 + column * 0.976 / columns
  set rmargin at screen 0.012 + (column + 1) * 0.976 / columns
  set tmargin at screen 1 - 420.0 / height - line * band
  set bmargin at screen 1 - 715.0 / height - line * band
  set label 1 value(sprintf("panel%d", n)) at graph 0.5, graph 1.0 center offset 0, 0.8 noenhanced font ",13"
  set palette maxcolors 3 defined (0 "#0072b2", 1 "#d55e00", 2 "#009e73")
  set cbrange [0 : 2]
  plot tsv index "[rest]" using 1:2 with lines lw 1 lc rgb "#b8b8b8", \
    tsv index sprintf("[shape %d]", n) using 1:2:3 with lines lw 2 lc palette
}
eval(below)
unset multiplot
