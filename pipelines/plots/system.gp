# A system of gears: all at their places, and the teeth about the pitch point of a mesh of each [[mesh]]; mm, equal axes.
# Variables from gear-plot: tsv, heading, line1.., notes, height; of the main panel main_left, main_top, main_width, main_height (pixels),
# left, right, low, high (mm); has_<block> (1: there is one); labels, label1.., label_x1.., label_y1.. (mm); close_ups, close_size (pixels), and of each close-up
# close1.., close_x1.., close_y1.., close_half1.. (mm), close_left1.., close_top1.. (pixels).
load plots . "/common.gp"
unset grid
foot_name = "line%d"
lift = room(notes)

set multiplot title heading offset 0, -0.2
set border 15 lw 1.2
unset key
set size ratio -1
x_of(pixels) = pixels / 1600.0
y_of(pixels) = 1 - pixels / height
central_line = colour[1]
planet_line = "#b3401a"
lines_of(name, w, colour) = value("has_" . name) == 1 ? sprintf(', tsv index "[%s]" using 1:2 with lines lt 1 lw %g lc rgb "%s"', name, w, colour) : ""
area_of(name, colour) = value("has_" . name) == 1 ? sprintf(', tsv index "[%s]" using 1:2 with filledcurves closed fc rgb "%s"', name, colour) : ""
both(name, fill, w, colour) = area_of(name, fill) . lines_of(name, w, colour)
shapes(w) = "NaN" . both("rim", "#e9f0fa", w, central_line) . both("second_rim", "#fbeee6", w, planet_line) \
  . both("hollow", "white", w, central_line) . both("second_hollow", "white", w, planet_line) . both("central", "#e9f0fa", w, central_line) \
  . both("planets", "#fbeee6", w, planet_line) . lines_of("carrier", 6, "#bfe3d6") . both("bores", "white", 1, "#666666") \
  . lines_of("circles", 1.4, central_line) . lines_of("planet_circles", 1.4, planet_line) . lines_of("paths", 2 * w, "black")

set lmargin at screen x_of(main_left)
set rmargin at screen x_of(main_left + main_width)
set tmargin at screen y_of(main_top)
set bmargin at screen y_of(main_top + main_height)
set xrange [left : right]
set yrange [low : high]
set xlabel "x (mm)" offset 0, 0.4
set ylabel "y (mm)" offset 0.6, 0
set style arrow 1 head filled size screen 0.011, 22, 60 fixed lt 1 lw 3 lc rgb colour[6]
do for [n = 1:int(labels)] {
  set label n value(sprintf("label%d", n)) at value(sprintf("label_x%d", n)), value(sprintf("label_y%d", n)) center offset 0, 0.3 front noenhanced font ",13"
}
do for [k = 1:int(close_ups)] {
  x = value(sprintf("close_x%d", k)); y = value(sprintf("close_y%d", k)); h = value(sprintf("close_half%d", k))
  set object k rectangle center x, y size 2 * h, 2 * h front fs empty border lc rgb "black" lw 1.4
}
eval("plot " . shapes(1) . lines_of("arcs", 3, "#444444") . ', tsv index "[heads]" using 1:2:3:4 with vectors arrowstyle 1')

unset label
unset object
unset xlabel
unset ylabel
unset tics
do for [k = 1:int(close_ups)] {
  x = value(sprintf("close_x%d", k)); y = value(sprintf("close_y%d", k)); h = value(sprintf("close_half%d", k))
  from = value(sprintf("close_left%d", k)); top = value(sprintf("close_top%d", k))
  set lmargin at screen x_of(from)
  set rmargin at screen x_of(from + close_size)
  set tmargin at screen y_of(top)
  set bmargin at screen y_of(top + close_size)
  set xrange [x - h : x + h]
  set yrange [y - h : y + h]
  set label 1 value(sprintf("close%d", k)) at graph 0.5, graph 1.0 center offset 0, 0.7 noenhanced font ",13"
  set label 2 sprintf("%.0f mm", 2 * h) at graph 0.5, graph 0 center offset 0, -0.8 font ",12"
  eval("plot " . shapes(2))
}
eval(below)
unset multiplot
