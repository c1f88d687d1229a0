# How planets share the load at rest: of each [[mesh]] of planets the share of each over the mesh period (left), and the loads of the
# tooth pairs of its first mesh (right).
# Variables from gear-plot: tsv, heading, line1.., notes, height, periods, rows, low, high (%) and, of each row k, first1.., labels1..,
# pairs1.. (with '|' between), curves1.., loads1.., equal1.. (%).
load plots . "/common.gp"

array pair_colour[6] = ["#882255", "#332288", "#88a000", "#44aa99", "#b07030", "#777777"]
foot_name = "line%d"
lift = room(notes)
part(words, i) = i == 1 ? words[1 : strstrt(words, "|") - 1] : part(words[strstrt(words, "|") + 1 : *], i - 1)

set multiplot title heading offset 0, -0.4
of(i) = colour[(i - 1) % 6 + 1]
dash(i) = i > 6 ? 2 : 1
row = ((1 - lift) * height - 110) / rows
do for [k = 1:int(rows)] {
  labels = value(sprintf("labels%d", k))
  pairs = value(sprintf("pairs%d", k))
  curves = int(value(sprintf("curves%d", k)))
  loads = int(value(sprintf("loads%d", k)))
  equal = value(sprintf("equal%d", k))
  set tmargin at screen 1 - (122.0 + row * (k - 1)) / height
  set bmargin at screen 1 - (row + 12.0 + row * (k - 1)) / height
  set lmargin at screen 0.1
  set rmargin at screen 0.38
  set xlabel "Mesh phase (mesh periods)" offset 0, 0.3
  set ylabel "Share of the load (%)"
  set yrange [low : high]
  set xrange [0:periods]
  if (periods == 1) { set xtics 0.2 } else { set xtics autofreq }
  set key at graph 1.03, graph 1.0 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced
  plot equal with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#444444" title "equal", \
    for [i = 1:curves] tsv index sprintf("[share %d]", k) using 1:i + 1 with lines lt 1 dt dash(i) lw (periods > 1 ? 1.2 : 2 + 0.7 * (curves - i)) lc rgb of(i) title word(labels, i)
  set lmargin at screen 0.64
  set rmargin at screen 0.89
  set xlabel sprintf("Phase of %s (mesh periods)", value(sprintf("first%d", k))) offset 0, 0.3 noenhanced
  set ylabel "Tooth loads (N)"
  set yrange [0 : *]
  set xrange [0:1]
  set xtics 0.2
  plot for [p = 1:loads] tsv index sprintf("[loads %d]", k) using 1:p + 1 with lines lt 1 lw 2.6 lc rgb pair_colour[(p - 1) % 6 + 1] title part(pairs, p)
}
eval(below)
unset multiplot
