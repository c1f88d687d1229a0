# Figure 3: the contact zone. (a) inner and outer region of the teeth in contact, (b) candidate pairs on the unloaded flanks,
# (c) pressure and separation under load.
# Variables from gear-plot: tsv, heading, note1.., matching, touch_y, half_window, reach, peak, strips, ring (0: both gears are external).
load plots . "/common.gp"
unset grid
lift = room(3)

driver_line = colour[1]
driven_line = "#b3401a"
driver_fill = "#f4f7fc"
driven_fill = "#fdf7f2"
driver_inner = "#c4d7f2"
driven_inner = "#f6d6bd"

set multiplot title heading offset 0, -0.2
set border 15 lw 1.2
set lmargin at screen 0.085
set rmargin at screen 0.475
set bmargin at screen 0.17 + lift
set tmargin at screen 0.785 + lift
set size ratio -1
set xlabel "x (mm)"
set ylabel "y (mm)"
# Numbers below an axis stand apart whatever the size of the teeth.
step = step_of(half_window / 6)
set xtics step > 2 ? step : 2
set ytics step > 2 ? step : 2
set xrange [-half_window : half_window]
set yrange [touch_y - half_window : touch_y + half_window]
set label 1 "{/:Bold (a)} inner region (tinted) and outer region of the two teeth" at graph 0.5, graph 1.0 center offset 0, 0.7 font ",15"
set key at screen 0.28, screen 0.012 + lift center bottom vertical maxrows 2 Left reverse samplen 2.2 spacing 1.1 font ",14"
region(gear, tone) = matching > 0 ? sprintf(', tsv index "[%s inner region]" using 1:2 with lines lt 1 lw 3 dt (8, 5) lc rgb %s_line notitle', gear, gear) \
  : sprintf(', tsv index "[%s inner region]" using 1:2 with filledcurves closed fc rgb "%s" notitle', gear, tone)
eval('plot tsv index "[driver outline]" using 1:2 with filledcurves closed fc rgb driver_fill notitle, ' \
  . 'tsv index "[driven outline]" using 1:2 with filledcurves closed fc rgb driven_fill notitle' \
  . region("driver", driver_inner) . region("driven", driven_inner) \
  . ', tsv index "[driver teeth]" using 1:2 with lines lt 1 lw 0.7 lc rgb driver_line notitle' \
  . ', tsv index "[driven teeth]" using 1:2 with lines lt 1 lw 0.7 lc rgb driven_line notitle' \
  . ', tsv index "[driver outline]" using 1:2 with lines lt 1 lw 2.4 lc rgb driver_line title "driver"' \
  . ', tsv index "[driven outline]" using 1:2 with lines lt 1 lw 2.4 lc rgb driven_line title "driven"' \
  . ', tsv index "[line of action]" using 1:2 with lines lt 1 lw 2 dt (14, 8) lc rgb "black" title "common normal (line of action)"' \
  . ', "+" using (0):(touch_y) every ::0::0 with points pt 7 ps 1.2 lc rgb "black" title "contact zone of (b), (c)"')

set size noratio
set lmargin at screen 0.575
set rmargin at screen 0.905
set xrange [-reach : reach]
set xtics step_of(2 * reach / 7)
set mxtics 2
set ytics auto
set border 3 lw 1.4
set grid lt 1 lc rgb "#e8e8e8" lw 1

# (b) heights are drawn far larger than lengths
set tmargin at screen 0.785 + lift
set bmargin at screen 0.535 + lift
set xlabel
set yrange [*:*]
set offsets graph 0, graph 0, graph 0.4, graph 0.1
set ylabel "Height (µm)"
set ytics auto
set label 1 "{/:Bold (b)} unloaded flanks, candidate pairs P, G"
# Both flanks of an internal pair bend the same way, away from the bottom.
set key at graph 0.5, graph (ring > 0 ? 0.24 : 0.98) center top maxrows 2 samplen 2.2 opaque
picked = int(0.8 * strips)
plot tsv index "[flanks]" using 1:3 with lines lt 1 lw 2.6 lc rgb driven_line title "driven", \
  tsv index "[flanks]" using 1:2 with lines lt 1 lw 2.6 lc rgb driver_line title "driver", \
  tsv index "[candidate pairs]" using 1:2:(0):($3 - $2) with vectors nohead lt 1 lw 1.2 lc rgb "#505050" title "candidate pair", \
  "" index "[candidate pairs]" using 1:2 with points pt 7 ps 0.8 lc rgb driver_line notitle, \
  "" index "[candidate pairs]" using 1:3 with points pt 7 ps 0.8 lc rgb driven_line notitle, \
  "" index "[candidate pairs]" using ($0 == picked ? $1 : NaN):2:("P") with labels offset 0, -0.9 tc rgb driver_line notitle, \
  "" index "[candidate pairs]" using ($0 == picked ? $1 : NaN):3:("G") with labels offset 0, 0.8 tc rgb driven_line notitle

# (c)
set offsets 0, 0, 0, 0
set tmargin at screen 0.44 + lift
set bmargin at screen 0.17 + lift
set border 11 lw 1.4
set xlabel "Along the flank, to the driver's tip (mm)"
set ylabel "Pressure (MPa)"
set y2label "Separation (µm)" offset -0.6
set ytics auto nomirror
set y2tics
set yrange [0 : 1.4 * peak]
set y2range [0 : *]
set label 1 "{/:Bold (c)} under load: a strip carries pressure or is apart"
set key at screen 0.74, screen 0.012 + lift center bottom vertical maxrows 2 opaque
plot tsv index "[candidate pairs]" using (0.5 * ($4 + $5)):8:($5 - $4) with boxes fs solid 0.6 border lc rgb colour[9] fc rgb "#c9d9ee" title "pressure on a strip", \
  tsv index "[Hertz]" using 1:2 with lines lt 1 lw 2 dt (10, 5) lc rgb "black" title "Hertz, same force", \
  tsv index "[candidate pairs]" using 1:7 axes x1y2 with points pt 6 ps 1.4 lw 2 lc rgb colour[3] title "separation (right)"
eval(below)
unset multiplot
