# Load sharing at rest: the share of the load that a tooth pair carries on its way through the mesh, one curve per torque (a), and
# the loads of all pairs over a mesh period at the first torque (b).
# Variables from gear-plot: tsv, heading, note1, note2, curves, labels, pairs, first_pair, path_start, path_end, static_force, torque.
load plots . "/common.gp"
lift = room(2)

array pair_colour[6] = ["#882255", "#332288", "#88a000", "#44aa99", "#b07030", "#777777"]
set multiplot layout 1, 2 title heading offset 0, -0.4 \
  margins screen 0.085, 0.985, 0.26 + lift, 0.815 + lift spacing screen 0.1
set key Left reverse vertical maxrows 3 samplen 2.5 spacing 1.2 font ",14" center bottom

set key at screen 0.285, screen 0.012 + lift
set xlabel "Phase of the pair (mesh periods, 0: pitch point)\n{/:Bold (a)}"
set ylabel "Share of the load (%)"
set yrange [0:104]
set xrange [path_start - 0.35 : path_end + 0.35]
set mxtics 2
# On the line of action: first and last contact, and between them the part with one pair alone.
n = 0
do for [x in sprintf("%.6f %.6f %.6f %.6f", path_start, path_end - 1, path_start + 1, path_end)] {
  n = n + 1
  set arrow n from real(x), graph 0 to real(x), graph 1 nohead back lw 1.4 dt (8, 6) lc rgb (n == 1 || n == 4 ? "#505050" : "#9a9a9a")
}
# Curves lie on each other over much of the path: what is drawn first shows on either side of what is drawn on it.
thick(i) = 1.8 + 1.1 * (curves - i)
plot for [i = 1:curves] tsv index "[share]" using 1:i + 1 with lines lt 1 lw thick(i) lc rgb colour[i] title word(labels, i)

do for [i = 1:4] { unset arrow i }
set key at screen 0.785, screen 0.012 + lift maxrows 3
set xlabel "Mesh phase (mesh periods, 0: pitch point)\n{/:Bold (b)} " . torque
set ylabel "Load (N)"
set xrange [0:1]
set yrange [0:*]
name(j) = j == 0 ? "reference pair" : sprintf("%s pair%s", j > 0 ? "preceding" : "following", abs(j) > 1 ? sprintf(" %d", abs(j)) : "")
plot tsv index "[loads]" using 1:2 with lines lt 1 lw 1.8 dt (5, 4) lc rgb "#444444" title "all pairs", \
  static_force with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#009e73" title sprintf("T / r_b = %.0f N", static_force), \
  for [p = 1:pairs] tsv index "[loads]" using 1:2 + p with lines lt 1 lw 2.6 lc rgb pair_colour[int(p - 1) % 6 + 1] title name(int(first_pair + p - 1))
eval(below)
unset multiplot
