# Load over the flank of a pair in slices: line load over face and path of contact as colours (a), and of each tooth pair over the face at
# mesh phase 0 (b).
# Variables from gear-plot: tsv, heading, note1, note2, labels, curves, half_face, path_start, path_end, largest, line_largest, height.
load plots . "/common.gp"
unset grid
set datafile separator whitespace
lift = room(2)
set multiplot title heading offset 0, -0.3
set border 15 lw 1.6 front
set tics out nomirror front
set palette defined (0 "#f7fbff", 0.1 "#d6e6f4", 0.25 "#abcfe6", 0.45 "#6aaed6", 0.7 "#2e7ebc", 1 "#08306b")
set tmargin at screen 1 - 150.0 / height + lift
set bmargin at screen 0.155 + lift
set lmargin at screen 0.08
set rmargin at screen 0.46
set xlabel "Along the face, from its middle (mm)\n{/:Bold (a)} line load (N/mm), lines of contact"
set ylabel "Path of contact, driver's root to tip (mm)"
set xrange [-half_face:half_face]
set yrange [path_start:path_end]
set cbrange [0:largest]
set colorbox user origin screen 0.475, 0.155 + lift size screen 0.014, 0.65
unset key
plot tsv index "[flank]" using 1:2:3 with image, \
  tsv index "[lines]" using 1:2 with lines lw 1.6 lc rgb "#c8201e"

unset colorbox
set border 3
set lmargin at screen 0.66
set rmargin at screen 0.97
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
set xlabel "Along the face, from its middle (mm)\n{/:Bold (b)} mesh phase 0"
set ylabel "Line load (N/mm of face)"
set yrange [0:1.35 * line_largest]  # room for the key
set key top right Right samplen 2.5 spacing 1.2 font ",14"
plot for [i = 1:curves] tsv index "[pair ".i."]" using 1:2 with linespoints lw 2.8 pt 7 ps 0.8 lc rgb colour[(i + 4) % 6 + 1] title word(labels, i)
eval(below)
unset multiplot
