# Flank pressure over roll angle and speed as colours, rising speed (a) and, where it differs, falling speed (b); beside them the
# largest over the flank and what tip edges carry, over speed.
# Variables from gear-plot: tsv, heading, line1, line2, ..., notes, height, labels, both, roll_from, roll_to, roll_step, path_from, path_to, speed_step,
# pressure_max, pressure_rest, edge_max, frequency_from, frequency_to, natural_frequency; pressure_rest: 0 if none is stated.
load plots . "/common.gp"
unset grid
foot_name = "line%d"
lift = room(notes)

set multiplot title heading offset 0, -0.3
set tics out nomirror font ",14"
span = frequency_to - frequency_from
span = span > 0 ? span : 0.2 * frequency_to
half_tall = 0.53 * (speed_step > 0 ? speed_step : span)
half_wide = 0.53 * roll_step
set palette defined (0 "#f4f1ea", 0.25 "#c9dcea", 0.5 "#6aaed6", 0.75 "#2166ac", 0.9 "#7a1f5c", 1 "#c8201e")
rows = both == 1 ? 2 : 1
# Between the title, and axis and notes.
tall = (height - 250.0) / rows
top(r) = 1 - (185.0 + (r - 1) * tall) / height + lift
foot(r) = 1 - (185.0 + r * tall - (r < rows ? 88 : 45)) / height + lift
do for [r = 1:rows] {
  set tmargin at screen top(r)
  set bmargin at screen foot(r)
  set lmargin at screen 0.085
  set rmargin at screen 0.495
  unset key
  unset grid
  set xrange [roll_from - half_wide : roll_to + half_wide]
  set yrange [frequency_from - half_tall : frequency_to + half_tall]
  set cbrange [0 : pressure_max]
  set cblabel "Pressure (MPa)" offset -0.1
  set colorbox user origin screen 0.508, foot(r) size screen 0.012, top(r) - foot(r)
  set xlabel (r == rows ? "Roll angle of " . word(labels, 1) . " (deg)" : "") offset 0, 0.3 noenhanced
  set ylabel speed_label offset 1.9
  set label 1 (r == 1 ? "{/:Bold (a)} speed rising" : "{/:Bold (b)} speed falling") at graph 0, graph 1 offset 0, 0.8 font ",14"
  set arrow 5 from path_from, graph 0 to path_from, graph 1 nohead front lt 1 lw 1.2 lc rgb "#505050"
  set arrow 6 from path_to, graph 0 to path_to, graph 1 nohead front lt 1 lw 1.2 lc rgb "#505050"
  map = r == 1 ? "[map up]" : "[map down]"
  plot tsv index map using 7:($6 > 0 ? $4 : NaN):(half_wide):(half_tall) with boxxyerror fs solid 1 noborder lc rgb "#9a9a9a" notitle, \
    tsv index map using 7:($5 > 0 ? $4 : NaN):(half_wide):(half_tall):5 with boxxyerror fs solid 1 noborder lc palette notitle
  unset colorbox
}

unset arrow 5
unset arrow 6
# Half as tall each, whatever the number of maps.
upper = top(1)
lower = foot(rows)
middle = 0.5 * (upper + lower)
gap = 44.0 / height
set lmargin at screen 0.715
set rmargin at screen 0.985
set grid lt 1 lc rgb "#e4e4e4" lw 1
set key at graph 0.99, graph 0.04 right bottom Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced
set xrange [frequency_from - 0.02 * span : frequency_to + 0.02 * span]
# At most six numbers: those of high speeds are wide.
raw = span / 5
power = 10 ** floor(log10(raw))
set xtics power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1)
unset xlabel
if (natural_frequency > frequency_from && natural_frequency < frequency_to) {
  set arrow 1 from natural_frequency, graph 0 to natural_frequency, graph 1 nohead back lt 1 lc rgb "#9a9a9a" lw 1.2 dt (18, 10)
  set label 11 "f_n" at natural_frequency, graph 0.94 offset 0.5, 0 left tc rgb "#505050" font ",14"
}
set tmargin at screen upper
set bmargin at screen middle + gap
set yrange [0 : 1.25 * pressure_max]
set ylabel "Largest pressure (MPa)" offset 0.6
set label 1 (both == 1 ? "{/:Bold (c)}" : "{/:Bold (b)}") . " largest inside the flanks"
plot tsv index "[speed up]" using 1:($2 > 0 ? $2 : NaN) with lines lt 1 lw 2.6 lc rgb "#0072b2" title "rising", \
  tsv index "[speed down]" using 1:($2 > 0 ? $2 : NaN) with lines lt 1 lw 1.8 dt (10, 5) lc rgb "#d55e00" title "falling", \
  pressure_rest > 0 ? pressure_rest : NaN with lines lt 1 lw 1.4 dt (4, 4) lc rgb "#505050" title "at rest"

set xlabel speed_label offset 0, 0.3 enhanced
set tmargin at screen middle - gap
set bmargin at screen lower
set yrange [0 : edge_max > 0 ? 1.4 * edge_max : 1]
set key left top at graph 0.02, graph 0.98
set label 11 at natural_frequency, graph 0.6
set ylabel "Load over a tip edge (N)" offset 0.6
set label 1 (both == 1 ? "{/:Bold (d)}" : "{/:Bold (c)}") . " load of a pair over a tip edge"
array colour[2] = ["#0072b2", "#d55e00"]
array width[2] = [3.6, 1.6]
plot for [g = 1:2] tsv index "[speed up]" using 1:(column(g + 2)) with lines lt 1 lw width[g] lc rgb colour[g] title "edge of " . word(labels, g), \
  for [g = 1:2] tsv index "[speed down]" using 1:(column(g + 2)) with lines lt 1 lw width[g] dt (10, 5) lc rgb colour[g] notitle, \
  keyentry with lines lt 1 lw 2 dt (10, 5) lc rgb "#505050" title "dashed: falling"
eval(below)
unset multiplot
