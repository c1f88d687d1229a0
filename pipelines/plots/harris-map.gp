# Harris map: peak-to-peak transmission error against tip relief and torque (a), and against torque for the best relief of the
# design torque and none (b); with a dynamic part the RMS at the worst speed (c).
# Variables from gear-plot: tsv, heading, note1, note2, labels, curves, design_torque, largest, moving, height.
load plots . "/common.gp"
unset grid
set datafile separator whitespace
lift = room(2)

rows = moving > 0 ? 2 : 1
step = largest > 120 ? 20 : largest > 60 ? 10 : largest > 25 ? 5 : largest > 12 ? 2 : largest > 5 ? 1 : largest > 2 ? 0.5 : 0.2
set contour base
unset surface
# One label each, where the line has gone a little way from the edge of the map.
set style textbox opaque margins 0.4, 0.3 fc rgb "#ffffff" noborder
set cntrparam levels incremental step, step, 100 * step
set table $level
splot tsv index "[peak to peak]" using 1:2:3
unset table
unset contour
set surface
# A label at the edge of the map would be cut.
stats tsv index "[peak to peak]" using 1:2 nooutput name "map"
inside(x, low, high) = x > low + 0.04 * (high - low) && x < high - 0.04 * (high - low)
whole(x, y) = inside(x, map_min_x, map_max_x) && inside(y, map_min_y, map_max_y)
set multiplot title heading offset 0, -0.3
set border 15 lw 1.6 front
set tics out nomirror front
set palette defined (0 "#f7fbff", 0.1 "#d6e6f4", 0.25 "#abcfe6", 0.45 "#6aaed6", 0.7 "#2e7ebc", 1 "#08306b")
set tmargin at screen 1 - 195.0 / height + lift
set bmargin at screen (rows == 2 ? 0.56 : 0.155) + lift
set lmargin at screen 0.1
set rmargin at screen 0.42
set xlabel "Tip relief (µm)\n{/:Bold (a)} peak-to-peak transmission error (µm)"
set ylabel "Torque (N m)" offset 0.8
set xrange [*:*] noextend
set yrange [*:*] noextend
set colorbox user origin screen 0.435, (rows == 2 ? 0.56 : 0.155) + lift size screen 0.014, (rows == 2 ? 0.337 : 0.65)
unset key
plot tsv index "[peak to peak]" using 1:2:3 with image, \
  $level using 1:2 with lines lw 1.2 lc rgb "#ffffff", \
  $level using 1:2:(whole($1, $2) ? sprintf("%g", $3) : "") every 100000::10 with labels boxed tc rgb "#303030" font ",12", \
  tsv index "[best relief]" using 1:2 with lines lw 2.4 dt (10, 6) lc rgb "#c8201e", \
  tsv index "[optimum]" using 1:2 with points pt 3 ps 2.6 lw 3 lc rgb "#c8201e"

unset colorbox
set border 3
set lmargin at screen 0.575
set rmargin at screen 0.97
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
set xlabel "Torque (N m)\n{/:Bold (b)}"
set xtics step_of(map_max_y / 5)
set ylabel "Peak-to-peak transmission error (µm)"
set xrange [0:*]
set yrange [0:*]
set key top left Left reverse samplen 2.5 spacing 1.2 font ",14"
set arrow 1 from design_torque, graph 0 to design_torque, graph 1 nohead back lw 1.4 dt (8, 6) lc rgb "#808080"
plot for [i = 1:curves] tsv index "[cusp]" using 1:i + 1 with lines lw 2.8 lc rgb colour[i == 7 ? 7 : (i + 4) % 6 + 1] title word(labels, i)

if (moving > 0) {
  unset arrow
  unset grid
  unset key
  set border 15
  set tmargin at screen 0.44 + lift
  set bmargin at screen 0.085 + lift
  set lmargin at screen 0.1
  set rmargin at screen 0.42
  set xrange [*:*] noextend
  set yrange [*:*] noextend
  set colorbox user origin screen 0.435, 0.085 + lift size screen 0.014, 0.355
  set xtics autofreq
  set xlabel "Tip relief (µm)\n{/:Bold (c)} RMS at the worst speed (µm)"
  set ylabel "Torque (N m)"
  plot tsv index "[rms]" using 1:2:3 with image
}
eval(below)
unset multiplot
