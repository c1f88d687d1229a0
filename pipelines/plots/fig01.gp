# Figure 1: the finite element mesh of the pair (a) and of the teeth in mesh (b); lengths in mm, equal axes.
# Variables from gear-plot: tsv, heading, note1.., pitch_y, half_window, driver_radius, driven_radius (of the tips, or of a rim),
# driven_y (its centre), ring (0: none, 1: the driver, 2: the driven gear is internal).
load plots . "/common.gp"
unset grid
lift = room(3)

driver_line = colour[1]
driven_line = "#b3401a"
driver_fill = "#e9f0fa"
driven_fill = "#fbeee6"

set multiplot title heading offset 0, -0.2
set border 15 lw 1.2
unset key
set size ratio -1

# (a) whole gears: fill, bore, elements
tip = driver_radius > driven_radius ? driver_radius : driven_radius
lowest = driven_y - driven_radius < -driver_radius ? driven_y - driven_radius : -driver_radius
highest = driven_y + driven_radius > driver_radius ? driven_y + driven_radius : driver_radius
# A ring is its rim less what its teeth enclose; the pinion lies on that.
inner = ring == 1 ? "driven" : "driver"
outer = ring == 1 ? "driver" : "driven"
inner_fill = ring == 1 ? driven_fill : driver_fill
outer_fill = ring == 1 ? driver_fill : driven_fill
filled(name) = sprintf("[%s %s]", name, ring > 0 && name eq outer ? "bore" : "outline")
hollow(name) = sprintf("[%s %s]", name, ring > 0 && name eq outer ? "outline" : "bore")
edge = 0.08 * tip
set lmargin at screen 0.10
set rmargin at screen 0.40
set bmargin at screen 0.175 + lift
set tmargin at screen 0.79 + lift
set xlabel "x (mm)"
set label 3 "{/:Bold (a)} both gears" at graph 0.5, graph 1.0 center offset 0, 0.7
set ylabel "y (mm)"
set xrange [-tip - edge : tip + edge]
set yrange [lowest - edge : highest + edge]
# About four steps of 1, 2 or 5 on the shorter axis: labels of a large pair must not run into each other.
step = step_of((2 * tip + 2 * edge) / 4)
set xtics step
set ytics step
set label 1 "driver" at 0, (ring == 1 ? -0.6 * driver_radius : 0) center front tc rgb driver_line font ",16"
set label 2 "driven" at 0, (ring == 2 ? driven_y - 0.6 * driven_radius : driven_y) center front tc rgb driven_line font ",16"
set object 1 rectangle center 0, pitch_y size 2 * half_window, 2 * half_window front fs empty border lc rgb "black" lw 1.5
plot tsv index filled(outer) using 1:2 with filledcurves closed fc rgb outer_fill notitle, \
  tsv index hollow(outer) using 1:2 with filledcurves closed fc rgb "white" notitle, \
  tsv index filled(inner) using 1:2 with filledcurves closed fc rgb inner_fill notitle, \
  tsv index hollow(inner) using 1:2 with filledcurves closed fc rgb "white" notitle, \
  tsv index "[driver gear]" using 1:2 with lines lt 1 lw 0.25 lc rgb driver_line notitle, \
  tsv index "[driven gear]" using 1:2 with lines lt 1 lw 0.25 lc rgb driven_line notitle

# (b) close-up about the pitch point
unset label 1
unset label 2
unset object 1
set key at screen 0.72, screen 0.012 + lift center bottom vertical maxrows 2 Left reverse samplen 2.5 spacing 1.1
set lmargin at screen 0.48
set rmargin at screen 0.96
set label 3 "{/:Bold (b)} teeth in mesh" at graph 0.5, graph 1.0 center offset 0, 0.7
set xrange [-half_window : half_window]
set yrange [pitch_y - half_window : pitch_y + half_window]
set xtics step_of(2 * half_window / 6)
set ytics step_of(2 * half_window / 6)
plot tsv index filled(outer) using 1:2 with filledcurves closed fc rgb outer_fill notitle, \
  tsv index hollow(outer) using 1:2 with filledcurves closed fc rgb (ring > 0 ? "white" : outer_fill) notitle, \
  tsv index filled(inner) using 1:2 with filledcurves closed fc rgb inner_fill notitle, \
  tsv index "[driver teeth]" using 1:2 with lines lt 1 lw 0.7 lc rgb driver_line notitle, \
  tsv index "[driven teeth]" using 1:2 with lines lt 1 lw 0.7 lc rgb driven_line notitle, \
  tsv index "[driver outline]" using 1:2 with lines lt 1 lw 2 lc rgb driver_line title "driver", \
  tsv index "[driven outline]" using 1:2 with lines lt 1 lw 2 lc rgb driven_line title "driven", \
  tsv index "[path of contact]" using 1:2 with lines lt 1 lw 2.2 dt (14, 8) lc rgb "black" title "path of contact", \
  tsv index "[pitch point]" using 1:2 with points pt 7 ps 1.1 lc rgb "black" title "pitch point"
eval(below)
unset multiplot
