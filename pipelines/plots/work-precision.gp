# Work-precision: error against CPU time, one panel an observable, one line a choice; rings: the scene's settings.
# Variables from whine-work-precision: tsv, title, note1, note2, labels, axes, fold_width.
load plots . "/common.gp"
lift = room(2)

array colour[9] = ["#0072b2", "#6fa8dc", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#444444", "#d147a3", "#00a0a0"]
array mark[9] = [7, 6, 5, 9, 11, 13, 4, 8, 2]

set multiplot layout 2, 3 title title offset 0, -0.2 \
  margins screen 0.075, 0.985, 0.09 + lift, 0.82 + lift spacing screen 0.085, 0.125
set tics out nomirror font ",15"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "CPU (s)" font ",15" offset 0, 0.4
unset key
seen(x, least) = x < 0 ? NaN : (x < least ? least : x)
panel(c, least) = sprintf('plot for [i = 1:axes] tsv index sprintf("[%%s]", word(labels, i)) using 2:(seen(column(%d), %g)) ' \
  . 'with linespoints lt 1 lw 2 lc rgb colour[i] pt mark[i] ps 1.3, ' \
  . 'tsv index "[scene]" using 2:(seen(column(%d), %g)) with points pt 6 ps 2.4 lw 1.5 lc rgb "black"', c, least, c, least)
set ylabel "RMS, relative error" font ",15" offset 0.8
eval(panel(5, 1e-8))
set ylabel "mean, error / static deflection" font ",15" offset 0.8
eval(panel(6, 1e-8))
set ylabel "peak tooth load, relative error" font ",15" offset 0.8
eval(panel(7, 1e-8))
set ylabel "jump, speed falling, error (Hz)" font ",15" offset 0.8
eval(panel(8, fold_width))
set ylabel "jump, speed rising, error (Hz)" font ",15" offset 0.8
eval(panel(9, fold_width))

unset logscale
unset border
unset tics
unset xlabel
unset ylabel
unset grid
set key at graph 0.08, graph 0.97 left top vertical maxrows 12 Left reverse samplen 3 spacing 1.2 font ",15"
set xrange [0:1]
set yrange [0:1]
plot for [i = 1:axes] NaN with linespoints lt 1 lw 2 lc rgb colour[i] pt mark[i] ps 1.3 title word(labels, i), \
  NaN with points pt 6 ps 2.4 lw 1.5 lc rgb "black" title "the scene's settings"
eval(below)
unset multiplot
