# Figure 5: RMS of the oscillating dynamic transmission error against mesh frequency, both sweep directions.
# Variables from gear-plot: tsv, title, note1.., natural_frequency, frequency_from, frequency_to, rms_max, jumps_up,
# jumps_down, contact_lost.
set datafile separator tab
set datafile commentschars "#"

up_colour = "#1f4e9c"
down_colour = "#c8201e"
grey = "#9a9a9a"

span = frequency_to - frequency_from
margin = span > 0 ? 0.02 * span : 1.0
top = (rms_max > 0 ? rms_max : 1.0) * 1.36
set xrange [frequency_from - margin : frequency_to + margin]
set yrange [-0.035 * top : top]

set title title . "\n{/*0.68 " . note1 . "}\n{/*0.68 " . note2 . "}\n{/*0.68 " . note3 . "}" offset 0, 0.9
set xlabel "Mesh frequency (Hz)"
set ylabel "RMS of oscillating DTE (µm)"
set xtics out nomirror
set mxtics 5
set ytics out nomirror
set mytics 2
set grid xtics ytics lt 1 lc rgb "#e4e4e4" lw 1
set border 3 lw 1.6
set key at screen 0.52, screen 0.012 center bottom vertical maxrows 2 samplen 2.5 spacing 1.2 Left reverse
set lmargin at screen 0.088
set rmargin at screen 0.975
set bmargin at screen 0.195
set tmargin at screen 0.81

# f_n and its fractions, where superharmonic resonances stand
array name[3] = ["f_n", "f_n/2", "f_n/3"]
do for [n = 1:3] {
  f = natural_frequency / n
  if (f > frequency_from && f < frequency_to) {
    set arrow from f, graph 0 to f, graph 1 nohead back lt 1 lc rgb grey lw 1.4 dt (18, 10)
    set label sprintf("%s", name[n]) at f, graph 1.0 offset 0, 0.55 center tc rgb "#505050" font ",15"
  }
}

# Where the directions agree the filled blue triangle stands inside the open red one.
curves = 'tsv index "[down]" using 1:2 with linespoints lt 1 lw 1.8 pt 10 ps 2.1 lc rgb down_colour notitle' \
  . ', tsv index "[up]" using 1:2 with linespoints lt 1 lw 1.8 pt 9 ps 1.25 lc rgb up_colour notitle'

# Bars along the foot: speeds at which the teeth part during the period.
lost(direction, height) = ', tsv index "[' . direction . ']" using 1:($4 > 0 ? ' . height . ' * top : NaN)' \
  . ' with points pt 5 ps 0.75 lc rgb ' . direction . '_colour notitle'

# Each curve stops at a jump; an arrow leads to the branch on which the march goes on. Its frequency stands on a leader
# up to the top, those of neighbours in several rows.
label_y(row) = top * (0.99 - 0.20 * row)
larger(a, b) = a > b ? a : b
head = 0.02 * top
sign(x) = x < 0 ? -1 : 1
jumps(direction, shift) = sprintf(', tsv index "[jumps %s]" using 1:2:(0):($3 - $2) with vectors nohead' \
  . ' lt 1 lw 2.4 dt (14, 8) lc rgb %s_colour notitle' \
  . ', "" index "[jumps %s]" using 1:($3 - head * sign($3 - $2)):(0):(head * sign($3 - $2)) with vectors head filled' \
  . ' size screen 0.008, 24 fixed lt 1 lw 2.4 lc rgb %s_colour notitle', \
    direction, direction, direction, direction) \
  . sprintf(', "" index "[jumps %s]" using 1:(larger($2, $3)):(0):(label_y($5) - larger($2, $3)) with vectors nohead' \
  . ' lt 1 lw 1.2 dt (6, 8) lc rgb %s_colour notitle' \
  . ', "" index "[jumps %s]" using 1:(label_y($5)):(sprintf("jump %%.0f Hz", $1)) with labels rotate by 90' \
  . ' right offset %s font ",15" tc rgb %s_colour notitle', direction, direction, direction, shift, direction)
# The legend in reading order, whatever is drawn first.
legend = ', keyentry with linespoints lt 1 lw 1.8 pt 9 ps 1.25 lc rgb up_colour title "speed rising"' \
  . ', keyentry with linespoints lt 1 lw 1.8 pt 10 ps 2.1 lc rgb down_colour title "speed falling"'
legend_lost = ', keyentry with points pt 5 ps 1.2 lc rgb up_colour title "contact lost, rising"' \
  . ', keyentry with points pt 5 ps 1.2 lc rgb down_colour title "contact lost, falling"'
legend_jump(direction, word) = sprintf(', keyentry with lines lt 1 lw 2.4 dt (14, 8) lc rgb %s_colour title "jump, %s"', \
  direction, word)
if (contact_lost > 0) { curves = curves . lost("down", "-0.026") . lost("up", "-0.012"); legend = legend . legend_lost }
if (jumps_up > 0) { curves = curves . jumps("up", "char 0.9, 0"); legend = legend . legend_jump("up", "rising") }
if (jumps_down > 0) { curves = curves . jumps("down", "char -0.7, 0"); legend = legend . legend_jump("down", "falling") }
eval("plot " . curves . legend)
