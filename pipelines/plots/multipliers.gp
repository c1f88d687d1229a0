# Floquet multipliers of a branch: in the complex plane, with the unit circle (a), and the largest modulus against the mesh
# frequency (b). Filled: stable orbits, open: unstable ones.
# Variables from gear-plot: tsv, heading, largest, notes, line1.., height.
load plots . "/common.gp"
foot_name = "line%d"
lift = room(notes)

stats tsv index "[modulus]" using 1 nooutput name "speed"
set multiplot title heading offset 0, -0.2
set border 15 lw 1.6
bottom = 100.0 / height + lift
top = 1 - 90.0 / height
reach = largest > 1.05 ? 1.05 * largest : 1.1
set bmargin at screen bottom
set tmargin at screen top
set lmargin at screen 0.07
set rmargin at screen 0.07 + (top - bottom) * height / 1600.0
set xrange [-reach:reach]
set yrange [-reach:reach]
set xlabel "Real part" offset 0, 0.4
set ylabel "Imaginary part" offset 1, 0
set cblabel "Mesh frequency (Hz)" offset 1.6, 0
set palette defined (0 "#1f4e9c", 0.5 "#1a9d8f", 1 "#e6a817")
set colorbox vertical user origin screen 0.085 + (top - bottom) * height / 1600.0, screen bottom size screen 0.012, screen top - bottom
set parametric
set trange [0:2*pi]
set label 1 "{/:Bold (a)}" at graph 0.02, 0.96
plot cos(t), sin(t) with lines lw 2 lc rgb "#444444" notitle, \
  tsv index "[multipliers]" using ($4 == 1 ? $1 : NaN):2:3 with points pt 7 ps 0.9 palette notitle, \
  tsv index "[multipliers]" using ($4 == 0 ? $1 : NaN):2:3 with points pt 6 ps 1.4 lw 2 palette notitle
unset parametric
unset colorbox
set lmargin at screen 0.73
set rmargin at screen 0.965
set autoscale x
if (speed_max > speed_min) { set xtics step_of((speed_max - speed_min) / 4) }
set yrange [0:1.15 * reach]
set key top right
set xlabel "Mesh frequency (Hz)"
set ylabel "Largest modulus"
set label 1 "{/:Bold (b)}" at graph 0.02, 0.96
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 2 lc rgb "#444444"
plot tsv index "[modulus]" using 1:2 with lines lw 1.2 lc rgb "#b0b0b0" notitle, \
  tsv index "[modulus]" using ($3 == 1 ? $1 : NaN):2 with points pt 7 ps 0.7 lc rgb "#0072b2" title "stable", \
  tsv index "[modulus]" using ($3 == 0 ? $1 : NaN):2 with points pt 6 ps 1.2 lw 2 lc rgb "#d55e00" title "unstable"
eval(below)
unset multiplot
