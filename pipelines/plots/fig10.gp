# Loads of successive teeth over the mesh phase, a panel for each motion at one speed; shaded: no tooth carries force
# (Figures 10 and 11).
# Variables from gear-plot: tsv, title, lines, line1.., motions, height, largest, static_force, phase_from, phase_to, first_tooth,
# last_tooth, and for each motion a, b, ..: title_a, result_a, lost_a, shown_a_0 .. (does the first, second tooth carry load?).
load plots . "/common.gp"

letters = "a b c d e f"
foot_name = "line%d"
lift = room(lines)
set multiplot title title offset 0, -0.3
set mxtics 5
set lmargin at screen (largest >= 1e5 ? 0.105 : 0.092)
set rmargin at screen 0.84
set xrange [phase_from:phase_to]
set yrange [0 : 1.08 * largest]
set ylabel "Force (N)" offset (largest >= 1e5 ? 1.3 : 0.5), 0
colour(t) = t == 0 ? "#0072b2" : (t == 1 ? "#d55e00" : "#7f9fbf")
each = (height - 120 - 24 * lines) / motions
do for [m = 1:motions] {
  letter = word(letters, m)
  set tmargin at screen (height - 55 - (m - 1) * each - 50) / height
  set bmargin at screen (height - 55 - m * each + 45) / height
  set label 1 "{/:Bold (" . letter . ")} " . value("title_" . letter) . "; " . value("result_" . letter) at graph 0, graph 1 offset 0, 0.9 font ",12" noenhanced
  set label 1 enhanced
  if (m == motions) { set xlabel "Phase of tooth i (mesh periods, 0: it touches at the pitch point)" } else { unset xlabel }
  set key at graph 1.02, graph 0.98 left top Left reverse samplen 2 spacing 1.2 font ",14"
  shade = value("lost_" . letter) > 0 ? 'tsv index "[' . letter . ' contact lost]" using (0.5 * ($1 + $2)):(1.08 * largest):($2 - $1) ' \
    . 'with boxes fs solid 1 noborder lc rgb "#f3d9a8" title "contact lost", ' : ''
  teeth = ''
  do for [t = first_tooth:last_tooth] {
    if (value(sprintf("shown_%s_%d", letter, t - first_tooth)) == 0) { continue }
    teeth = teeth . sprintf(', tsv index "[%s tooth i%+d]" using 1:2 with lines lt 1 lw %g lc rgb "%s" %s', letter, t, \
      t == 0 || t == 1 ? 3.0 : 1.8, colour(t), t == 0 ? 'title "tooth i"' : (t == 1 ? 'title "tooth i + 1"' : (t == -1 ? 'title "other teeth"' : 'notitle')))
  }
  eval("plot " . shade . 'tsv index "[' . letter . ' mesh force]" using 1:2 with lines lt 1 lw 1.6 dt (5, 4) lc rgb "#444444" title "all teeth", ' \
    . 'static_force with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#009e73" title sprintf("T / r_b = %.0f N", static_force)' . teeth)
}
eval(below)
unset multiplot
