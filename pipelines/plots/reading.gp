# Readings of P2000: agreeing claims against the level ratio (left), sets of claims that hold together (right).
# Variables from gear-plot: tsv, title, note1, drawn_0.., kind_0.., sets, set_1.., held_1.., ratio_from, ratio_to, table1_ratio, fig15_from, fig15_to.
load plots . "/common.gp"
array colour[4] = ["#0072b2", "#009e73", "#e69f00", "#c0504d"]
array mark[4] = [7, 5, 9, 13]
set multiplot title title . "\n{/*0.68 " . note1 . "}" offset 0, -0.3

set lmargin at screen 0.08
set rmargin at screen 0.50
set tmargin at screen 0.84
set bmargin at screen 0.11
set xlabel "Mesh stiffness with two pairs over that with one, 100 N m"
set ylabel "Claims of P2000 that agree"
set xrange [ratio_from : ratio_to]
set yrange [0:*]
set key at graph 0.78, graph 0.24 opaque font ",13" title "corner contact" noenhanced
set object 1 rectangle from fig15_from, graph 0 to fig15_to, graph 1 fc rgb "#dddddd" fs solid noborder behind
set arrow 1 from table1_ratio, graph 0 to table1_ratio, graph 1 nohead back lt 1 lc rgb "#808080" lw 1.4 dt (12, 8)
set label 1 "Table 1" at table1_ratio, graph 0.03 offset 0.5, 0 left tc rgb "#505050" font ",13"
set label 2 "Figure 15" at fig15_from, graph 0.03 offset -0.5, 0 right tc rgb "#505050" font ",13"
drawn = ""
do for [k = 3:0:-1] {
  if (value(sprintf("drawn_%d", k)) > 0) {
    drawn = drawn . sprintf('%stsv index "[corner_%d]" using 1:2 with points pt %d ps 0.7 lc rgb "%s" title kind_%d', \
      strlen(drawn) > 0 ? ', ' : '', k, mark[k + 1], colour[k + 1], k)
  }
}
eval("plot " . drawn)

unset object
unset arrow
unset label
unset key
set lmargin at screen 0.72
set rmargin at screen 0.975
set xlabel "Satisfied in the closest reading (%)" font ",13"
unset ylabel
set xrange [0:100]
set xtics 0, 25, 100
set yrange [sets + 0.6 : 0.4]
unset grid
set grid xtics lt 1 lc rgb "#e4e4e4" lw 1
set ytics scale 0 ("" 1)
do for [i = 1:int(sets)] {
  set label i value(sprintf("set_%d", i)) at graph 0, first i offset -0.8, 0 right font ",13" noenhanced
  set label 100 + i value(sprintf("held_%d", i)) at 2, i left font ",12" front tc rgb "#ffffff" noenhanced
}
set boxwidth 0.7
plot tsv index "[sets]" using ($2 / 2):1:($2 / 2):(0.36) with boxxyerror fc rgb "#9a9a9a" fs solid noborder, \
  "" index "[sets]" using ($3 > 0 ? $2 / 2 : NaN):1:($2 / 2):(0.36) with boxxyerror fc rgb "#0072b2" fs solid noborder
unset multiplot
