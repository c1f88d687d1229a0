# One mesh period of a steady motion: the teeth near the mesh, and below them transmission error and tooth loads with a cursor.
# Variables from gear-animate: tsv, heading, note1, note2, height, first_frame, last_frame, frames, periods, magnified, half_window,
# along_x, along_y, static_force, largest_force, least_error, largest_error, pairs, first_pair, losses.
load plots . "/common.gp"
unset grid
lift = room(2)

stats tsv index "[frames]" using 1 nooutput name "place"
array at[int(frames)]; array error[int(frames)]; array force[int(frames)]
stats tsv index "[frames]" using (at[int($0) + 1] = $1, error[int($0) + 1] = $2, force[int($0) + 1] = $3, $1) nooutput
colour(pair) = colour[pair == 0 ? 1 : pair == 1 ? 2 : pair == -1 ? 3 : 8]
shade = losses > 0 ? 'tsv index "[contact lost]" using (0.5 * ($1 + $2)):(top):1:2:(bottom):(top) with boxxyerror fs solid 1 noborder lc rgb colour[10] notitle, ' : ''
do for [frame = int(first_frame):int(last_frame)] {
  now = at[frame + 1]
  name = sprintf("%03d", frame)
  set multiplot title heading offset 0, -0.3

  # the teeth
  unset xlabel; unset ylabel; unset xtics; unset ytics; unset border; unset key; unset grid
  set lmargin at screen 0.04; set rmargin at screen 0.96
  set tmargin at screen 0.87 + lift; set bmargin at screen 0.42 + lift
  wide = half_window * 1.55
  set xrange [-wide : wide]; set yrange [-wide * (0.45 * height) / (0.92 * 1600) : wide * (0.45 * height) / (0.92 * 1600)]
  set object 1 rectangle from graph 0, 0 to graph 1, 1 behind fc rgb (force[frame + 1] > 0 ? "#ffffff" : "#fdf3df") fs solid border lc rgb "#bbbbbb"
  set label 1 force[frame + 1] > 0 ? "" : "{/*1.2:Bold contact lost}" at graph 0.5, 0.85 center front tc rgb "#b07000"
  set label 2 "driven" at graph 0.5, 0.94 center front
  set label 3 "driver" at graph 0.5, 0.06 center front
  long = 0.5 * half_window / largest_force
  plot tsv index "[" . name . " driven]" using 1:2 with filledcurves closed fc rgb "#e3e6ea" fs solid 1 noborder notitle, \
       tsv index "[" . name . " driver]" using 1:2 with filledcurves closed fc rgb "#d3deeb" fs solid 1 noborder notitle, \
       tsv index "[" . name . " driven]" using 1:2 with lines lw 2 lc rgb colour[6] notitle, \
       tsv index "[" . name . " driver]" using 1:2 with lines lw 2 lc rgb "#2f4f77" notitle, \
       for [p = int(first_pair):int(first_pair + pairs) - 1] tsv index "[" . name . " force]" \
         using ($4 == p && $3 > 0 ? $1 : NaN):2:($3 * long * along_x):($3 * long * along_y) with vectors head filled size screen 0.01, 18 lw 5 lc rgb colour(p) notitle
  unset object 1; unset label 1; unset label 2; unset label 3

  # the whole period, a line where it is now
  set border 3 lw 1.6; set xtics out nomirror autofreq; set ytics out nomirror autofreq; set grid lt 1 lc rgb "#e4e4e4" lw 1
  set xrange [0 : periods]
  set lmargin at screen 0.1; set rmargin at screen 0.83
  set arrow 9 from now, graph 0 to now, graph 1 nohead front lw 2.5 lc rgb "#cc0000"
  set tmargin at screen 0.39 + lift; set bmargin at screen 0.25 + lift
  set format x ""
  raw = (largest_error - least_error) / 3
  set ytics step_of(raw > 0 ? raw : 1)
  set ylabel "DTE (µm)"
  bottom = least_error - 0.08 * (largest_error - least_error); top = largest_error + 0.08 * (largest_error - least_error)
  set yrange [bottom : top]
  eval("plot " . shade . 'tsv index "[history]" using 1:2 with lines lw 3 lc rgb "#333333" notitle')
  set tmargin at screen 0.23 + lift; set bmargin at screen 0.07 + lift
  set format x "%g"
  set xlabel "Mesh phase (mesh periods)" offset 0, 0.4
  set ytics autofreq
  set ylabel "Load (kN)"
  bottom = 0; top = 1.08e-3 * largest_force
  set yrange [bottom : top]
  set key at graph 1.02, graph 1.0 left top Left reverse samplen 2
  eval("plot " . shade . 'for [p = 0:int(pairs) - 1] tsv index "[history]" using 1:(1e-3 * column(4 + p)) with lines lw 3 lc rgb colour(int(first_pair) + p) ' \
    . 'title (int(first_pair) + p == 0 ? "pair 0" : sprintf("pair %+d", int(first_pair) + p)), tsv index "[history]" using 1:(1e-3 * $3) with lines lw 2 dt (5, 4) lc rgb "#000000" title "all pairs", ' \
    . '1e-3 * static_force with lines lw 1.4 dt (18, 8) lc rgb "#aaaaaa" title "T / r_b"')
  unset arrow 9
  eval(below)
  unset multiplot
}
