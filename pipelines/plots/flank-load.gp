# Load over the flank of a pair in slices, or of a mesh of each [[mesh]] of a train: line load over face and path of contact as colours, and of
# each tooth pair over the face at mesh phase 0.
# Variables from gear-plot: tsv, heading, note1 to note<feet>, rows, names (of meshes), labels and curves (of tooth pairs), ranges (half_face,
# path_start, path_end of each row), largest, line_largest, height.
load plots . "/common.gp"
unset grid
set datafile separator whitespace
lift = room(feet)
set multiplot title heading offset 0, -0.3
set tics out nomirror front
set palette defined (0 "#f7fbff", 0.1 "#d6e6f4", 0.25 "#abcfe6", 0.45 "#6aaed6", 0.7 "#2e7ebc", 1 "#08306b")
first = 0
do for [r = 1:int(rows)] {
  half_face = real(word(ranges, 3 * r - 2))
  bottom = (155.0 + 890 * (rows - r)) / height + lift
  set tmargin at screen bottom + 695.0 / height
  set bmargin at screen bottom
  set border 15 lw 1.6 front
  unset grid
  set lmargin at screen 0.08
  set rmargin at screen 0.46
  set xlabel "Along the face, from its middle (mm)\n{/:Bold (".letter(2 * r - 1).")} line load (N/mm), lines of contact"
  set ylabel "Path of contact, driver's root to tip (mm)"
  set xrange [-half_face:half_face]
  set yrange [real(word(ranges, 3 * r - 1)):real(word(ranges, 3 * r))]
  set cbrange [0:largest]
  set colorbox user origin screen 0.475, bottom size screen 0.014, 650.0 / height
  unset key
  if (strlen(names)) { set label 1 word(names, r) at graph 0, 1 offset 0, 0.8 left }
  plot tsv index "[flank ".r."]" using 1:2:3 with image, \
    tsv index "[lines ".r."]" using 1:2 with lines lw 1.6 lc rgb "#c8201e"
  unset label 1
  unset colorbox
  set border 3
  set lmargin at screen 0.66
  set rmargin at screen 0.97
  set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1
  set xlabel "Along the face, from its middle (mm)\n{/:Bold (".letter(2 * r).")} mesh phase 0"
  set ylabel "Line load (N/mm of face)"
  set yrange [0:1.35 * line_largest]  # room for the key
  set key top right Right samplen 2.5 spacing 1.2 font ",14"
  own = int(word(curves, r))
  plot for [i = 1:own] tsv index "[pair ".r." ".i."]" using 1:2 with linespoints lw 2.8 pt 7 ps 0.8 lc rgb colour[(i + 4) % 6 + 1] title word(labels, first + i)
  first = first + own
}
eval(below)
unset multiplot
