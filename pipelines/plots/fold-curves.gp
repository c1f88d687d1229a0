# Fold curves: mesh frequency of the folds against damping ratio, torque or tip relief; circles: cusps; crosses: jumps of sweeps.
# Variables from gear-plot: tsv, heading, axis, curves, label1.., folds_1.., cusps_1.., jumps_1.. (rows), notes, line1.., height.
load plots . "/common.gp"
unset grid
foot_name = "line%d"
lift = room(notes)

array tone[6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444"]
set title heading offset 0, -0.2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
set xlabel "Mesh frequency (Hz)"
set ylabel axis offset 0.5, 0
set key at graph 0.5, 0.98 center top vertical samplen 2 spacing 1.2 font ",15" noenhanced
set lmargin at screen 0.085
set rmargin at screen 0.965
set bmargin at screen 100.0 / height + lift
set tmargin at screen 1 - 80.0 / height
eval(foot_labels)
drawn = ''
rows(what, k) = value(sprintf("%s_%d", what, k))
do for [k = 1:int(curves)] {
  if (rows("folds", k) > 0) { drawn = drawn . sprintf('tsv index "[folds%d]" using 1:2 with linespoints lt 1 lw 2.4 pt 7 ps 0.6 lc rgb tone[%d] title label%d, ', k, k, k) }
  if (rows("jumps", k) > 0) { drawn = drawn . sprintf('tsv index "[jumps%d]" using 1:2 with points pt 2 ps 1.6 lw 2 lc rgb tone[%d] notitle, ', k, k) }
  if (rows("cusps", k) > 0) { drawn = drawn . sprintf('tsv index "[cusps%d]" using 1:2 with points pt 6 ps 2.2 lw 2.4 lc rgb tone[%d] notitle, ', k, k) }
}
any(what) = sum [k = 1:int(curves)] rows(what, k)
if (any("cusps") > 0) { drawn = drawn . 'keyentry with points pt 6 ps 1.8 lw 2 lc rgb "black" title "cusp", ' }
if (any("jumps") > 0) { drawn = drawn . 'keyentry with points pt 2 ps 1.5 lw 2 lc rgb "black" title "jump of a sweep", ' }
if (drawn eq "") {
  set xrange [0:1]
  set yrange [0:1]
  unset tics
  set label 1 "no folds in the range" at graph 0.5, 0.5 center tc rgb "#505050"
  drawn = 'NaN notitle, '
}
eval("plot " . drawn[1:strlen(drawn) - 2])
