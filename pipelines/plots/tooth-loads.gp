# Largest tooth load against mesh frequency for both directions of the sweep (a), and the loads of successive teeth over the mesh
# phase at the speed with the largest RMS (b); shaded there, marked at the foot here: contact lost.
# Variables from gear-plot: tsv, heading, note1, note2, height, frequency_from, frequency_to, speeds, load_max, worst_speed, contact_lost, beyond_backlash,
# largest, static_force, phase_from, phase_to, first_tooth, last_tooth, title_b, result_b, lost_b, shown_b_0 ..
load plots . "/common.gp"
lift = room(2)

set multiplot title heading offset 0, -0.3
set mxtics 5
set lmargin at screen 0.108
set rmargin at screen 0.84
set ylabel "Force (N)"

span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
set tmargin at screen 0.838 + lift
set bmargin at screen 0.555 + lift
set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
high = load_max > static_force ? load_max : static_force
set yrange [0 : 1.08 * (high > 0 ? high : 1)]
set xlabel speed_label
set label 1 "{/:Bold (a)} largest load of a tooth pair" at graph 0, graph 1 offset 0, 1.6 font ",14"
set arrow 1 from worst_speed, graph 0 to worst_speed, graph 1 nohead back lt 1 lw 1.4 dt (18, 10) lc rgb "#9a9a9a"
set label 2 "(b)" at worst_speed, graph 1 offset 0, 0.4 center tc rgb "#505050" font ",14"
set key at graph 1.02, graph 0.98 left top Left reverse samplen 2 spacing 1.2 font ",14"
curve(direction, what) = sprintf('tsv index "[%s]" using 1:%s', direction, what)
# Marks of rising and of falling speed stand at speeds of their own, so that both show where the directions agree.
stride = int(ceil(speeds / 60))
stride = stride < 2 && speeds > 30 ? 2 : stride
speed_step = speeds > 1 ? span / (speeds - 1) : 1.0
marked(f, falling) = int(floor((f - frequency_from) / speed_step + 0.5)) % (2 * stride) == (falling ? stride : 0)
drawn = curve("down", "6") . ' with lines lt 1 lw 2.6 lc rgb "#d55e00" notitle, ' \
  . curve("up", "6") . ' with lines lt 1 lw 1.4 lc rgb "#0072b2" notitle, ' \
  . curve("down", '(marked($1, 1) ? $6 : NaN)') . ' with points lt 1 lw 1.8 pt 10 ps 1.6 lc rgb "#d55e00" notitle, ' \
  . curve("up", '(marked($1, 0) ? $6 : NaN)') . ' with points lt 1 lw 1.8 pt 9 ps 1.3 lc rgb "#0072b2" notitle, ' \
  . 'keyentry with linespoints lt 1 lw 2.6 pt 10 ps 1.6 lc rgb "#d55e00" title "speed falling", ' \
  . 'keyentry with linespoints lt 1 lw 1.4 pt 9 ps 1.3 lc rgb "#0072b2" title "speed rising", ' \
  . 'static_force with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#009e73" title sprintf("T / r_b = %.0f N", static_force)'
if (contact_lost > 0) {
  drawn = drawn . ', ' . curve("down", '($4 > 0 ? 0.035 * high : NaN)') . ' with points pt 5 ps 0.6 lc rgb "#d55e00" notitle, ' \
    . curve("up", '($4 > 0 ? 0.015 * high : NaN)') . ' with points pt 5 ps 0.6 lc rgb "#0072b2" notitle, ' \
    . 'keyentry with points pt 5 ps 1 lc rgb "#444444" title "contact lost"'
}
if (beyond_backlash > 0) {
  drawn = drawn . ', ' . curve("down", '($8 > 0 ? $6 : NaN)') . ' with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" notitle, ' \
    . curve("up", '($8 > 0 ? $6 : NaN)') . ' with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" notitle, ' \
    . 'keyentry with points pt 6 ps 1.1 lw 1.4 lc rgb "#202020" title "beyond backlash"'
}
eval("plot " . drawn)

unset arrow
unset label 2
set tmargin at screen 0.425 + lift
set bmargin at screen 0.085 + lift
set xrange [phase_from:phase_to]
set yrange [0 : 1.08 * (largest > 0 ? largest : 1)]
set xlabel "Phase of tooth i (mesh periods, 0: it touches at the pitch point)"
set label 1 "{/:Bold (b)} " . title_b . "\n" . result_b at graph 0, graph 1 offset 0, 1.9 font ",14"
colour(t) = t == 0 ? "#0072b2" : (t == 1 ? "#d55e00" : "#7f9fbf")
shade = lost_b > 0 ? 'tsv index "[b contact lost]" using (0.5 * ($1 + $2)):(1.08 * largest):($2 - $1) ' \
  . 'with boxes fs solid 1 noborder lc rgb "#f3d9a8" title "contact lost", ' : ''
teeth = ''
do for [t = first_tooth:last_tooth] {
  if (value(sprintf("shown_b_%d", t - first_tooth)) == 0) { continue }
  teeth = teeth . sprintf(', tsv index "[b tooth i%+d]" using 1:2 with lines lt 1 lw %g lc rgb "%s" %s', t, \
    t == 0 || t == 1 ? 3.0 : 1.8, colour(t), t == 0 ? 'title "tooth i"' : (t == 1 ? 'title "tooth i + 1"' : (t == -1 ? 'title "other teeth"' : 'notitle')))
}
eval("plot " . shade . 'tsv index "[b mesh force]" using 1:2 with lines lt 1 lw 1.6 dt (5, 4) lc rgb "#444444" title "all teeth", ' \
  . 'static_force with lines lt 1 lw 1.4 dt (18, 8) lc rgb "#009e73" title sprintf("T / r_b = %.0f N", static_force)' . teeth)
eval(below)
unset multiplot
