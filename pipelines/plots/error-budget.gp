# Error budget: changes of the static answer when one discretisation is refined alone, as bars on a logarithmic scale;
# beyond a line those by another choice of the model.
# Variables from gear-plot: tsv, heading, line1, line2, ..., notes, labels, entries, choice_labels, choices, bars_each, top (%), pressure (1: budgets
# that know of pressure).
load plots . "/common.gp"
unset grid
foot_name = "line%d"
lift = room(notes)
set title heading offset 0, -0.2
set lmargin screen 0.1
set rmargin screen 0.97
set bmargin screen 0.2 + lift
set tmargin screen 0.81 + lift
set grid ytics lt 1 dt solid lc rgb "#e4e4e4" lw 1
set logscale y
set format y "10^{%L}"
set ylabel "Change (%)"
set yrange [1e-5:top]
set xrange [-0.6:entries + (choices > 0 ? choices + 0.1 : -0.4)]
set xtics ()
two_lines(s) = strstrt(s, "|") > 0 ? s[1:strstrt(s, "|") - 1] . "\n{/*0.66 " . s[strstrt(s, "|") + 1:*] . "}" : s
do for [i = 1:entries] { set xtics add (two_lines(word(labels, i)) i - 1) }
first_choice = entries + 0.5
do for [i = 1:choices] { set xtics add (two_lines(word(choice_labels, i)) first_choice + i - 1) }
# Bars beyond the seventh: pressure where it is known, then root stress where it is known.
array colour[9] = ["#0072b2", "#d55e00", "#333333", "#666666", "#8f8f8f", "#b5b5b5", "#d9d9d9", "#009e73", "#cc79a7"]
array name[9] = ["mean stiffness", "peak to peak", "harmonic 1", "harmonic 2", "harmonic 3", "harmonic 4", "harmonic 5", "flank pressure", "root stress"]
which(k) = k == 8 && pressure == 0 ? 9 : k
set key at screen 0.9, screen 0.085 + lift horizontal Left reverse samplen 1.5 maxrows 2
set style fill solid 0.9 noborder
set boxwidth 0.095
floor_value(x) = x < 1e-5 ? 1e-5 : x
bars = 'for [k = 1:bars_each] tsv index "[changes]" using ($1 + 0.1 * (k - 4.5)):(floor_value(column(k + 1))) with boxes' \
  . ' lc rgb colour[which(k)] title name[which(k)]'
if (choices > 0) {
  set arrow from entries - 0.22, graph 0 to entries - 0.22, graph 1 nohead lt 1 lw 1.6 lc rgb "#505050"
  set label "errors" at entries - 0.3, graph 0.97 right tc rgb "#505050"
  set label "other choices" at entries - 0.14, graph 0.97 left tc rgb "#505050"
  bars = bars . ', for [k = 1:bars_each] tsv index "[choices]" using (first_choice + $1 + 0.1 * (k - 4.5))' \
    . ':(floor_value(column(k + 1))) with boxes lc rgb colour[which(k)] notitle'
}
eval(foot_labels)
eval("plot " . bars)
