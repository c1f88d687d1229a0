# What every template begins with: `load plots . "/common.gp"`. Variables from the program: plots, height.
#
# Above a picture stand its title and its scene; notes stand below it, in lines of 24 pixels, those that are too long in several. A template
# writes `lift = room(2)`, adds lift to each vertical place on the screen, and ends with eval(below), which draws note1 and note2 there (or
# what foot_name says), once, in a plot of its own without axes; one that is no multiplot takes eval(foot_labels) before its plot.
set datafile separator tab
set datafile commentschars "#"
set border 3 lw 1.6
set tics out nomirror
set grid lt 1 dt solid lc rgb "#e4e4e4" lw 1

# of curves, told apart by all eyes and in print: blue, vermilion, green, purple, orange, dark; beside them black, grey, pale blue, shade,
# two more greys
array colour[12] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#444444", "#000000", "#9a9a9a", "#7f9fbf", "#f3d9a8", "#707070", "#d0d0d0"]

# of images and cells; of marks, whose lowest is not white
of_areas = 'set palette defined (0 "#ffffff", 0.15 "#e8eef4", 0.4 "#9fc4de", 0.65 "#3a7fbb", 0.82 "#5b2a86", 1 "#c8201e")'
of_marks = 'set palette defined (0 "#1f4e9c", 0.5 "#1a9d8f", 1 "#e6a817")'

# the step of numbers of an axis: 1, 2 or 5 times a power of ten and not below x > 0
step_of(x) = 10 ** floor(log10(x)) * (x / 10 ** floor(log10(x)) > 5 ? 10 : x / 10 ** floor(log10(x)) > 2 ? 5 : x / 10 ** floor(log10(x)) > 1 ? 2 : 1)

foot_name = "note%d"
foot_rows(n) = sprintf("rows_" . foot_name, n)
room(lines) = 24.0 * (sum [n = 1:int(lines)] (exists(foot_rows(n)) ? value(foot_rows(n)) : 1)) / height
foot_labels = 'foot_row = 0; foot_end = int(lift * height / 24 + 0.5); foot_number = 0; ' \
  . 'while (foot_row < foot_end) { foot_number = foot_number + 1; ' \
  . 'foot_words = sprintf(foot_name, foot_number); many = exists(foot_rows(foot_number)) ? int(value(foot_rows(foot_number))) : 1; ' \
  . 'do for [r = 1:many] { foot_row = foot_row + 1; ' \
  . 'foot_text = many > 1 ? value(sprintf("row%d_%s", r, foot_words)) : value(foot_words); ' \
  . 'set label 900 + foot_row foot_text at screen 0.5, screen lift + (6 - 24.0 * foot_row + 12) / height center font ",12" } }'
below = 'unset label; unset arrow; unset object; unset border; unset tics; unset grid; unset key; ' \
  . 'unset title; unset xlabel; unset ylabel; unset y2label; unset xzeroaxis; unset logscale; unset colorbox; ' \
  . 'set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1; ' \
  . 'set xrange [0:1]; set yrange [0:1]; ' . foot_labels . '; plot NaN notitle'
