# Designs at rest: static transmission error (a) and secant mesh stiffness (b) over the mesh period, amplitudes of the error's
# harmonics (c); a colour for each design.
# Variables from gear-plot: tsv, heading, height, labels, designs, error_low, error_high, stiffness_high, largest, harmonics, notes,
# line1...
load plots . "/common.gp"
foot_name = "line%d"
lift = room(notes)

array dash[6] = [1, 2, 4, 5, 3, 6]
top(y) = 1 - y * (1 - lift)
set multiplot title heading offset 0, -0.4
set lmargin at screen 0.105
set rmargin at screen 0.97
set xrange [0 : 1]
set key at graph 1, graph 1.02 right bottom horizontal Left reverse samplen 2.5 font ",15" noenhanced

set tmargin at screen top(0.10)
set bmargin at screen top(0.36)
span = error_high - error_low
span = span > 0 ? span : 1
set yrange [error_low - 0.08 * span : error_high + 0.08 * span]
set ylabel "Static TE (µm) {/:Bold (a)}"
plot for [i = 1:int(designs)] tsv index sprintf("[period %d]", i) using 1:2 with lines lt 1 lw 2.6 dt dash[i] lc rgb colour[i] title word(labels, i)

unset key
set tmargin at screen top(0.41)
set bmargin at screen top(0.63)
set yrange [0 : 1.08 * stiffness_high]
set ylabel "Mesh stiffness (N/µm) {/:Bold (b)}"
set xlabel "Mesh phase" offset 0, 0.4
plot for [i = 1:int(designs)] tsv index sprintf("[period %d]", i) using 1:3 with lines lt 1 lw 2.6 dt dash[i] lc rgb colour[i] notitle

set tmargin at screen top(0.72)
set bmargin at screen lift + 95.0 / height
set xrange [0.4 : harmonics + 0.6]
set xtics 1
set yrange [0 : 1.1 * (largest > 0 ? largest : 1)]
set ylabel "Amplitude of TE (µm) {/:Bold (c)}"
set xlabel "Harmonic of the mesh frequency" offset 0, 0.3
set style fill solid 0.85 noborder
wide = 0.8 / designs
plot for [i = 1:int(designs)] tsv index sprintf("[harmonics %d]", i) using ($1 - 0.4 + wide * (i - 0.5)):2:(wide * 0.92) with boxes lc rgb colour[i] notitle
eval(below)
unset multiplot
