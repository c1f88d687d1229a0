# Run-up: spectrogram of the mesh force (a), orders of the transmission error (b), largest tooth load and loss of contact in each
# mesh period (c), all over the mesh frequency and the speed of the driver.
# Variables from gear-plot: tsv, heading, height, driver, loudest, frequency_end, orders, largest, largest_sweep, largest_load, sweeps, sweep1,
# sweep2, level_label, level_low, level_high, speed_label, speed_scale, frequency_from, frequency_to, natural_frequency, rpm_per_hertz, notes, note1...
load plots . "/common.gp"
unset grid
lift = room(notes)

set palette defined (0 "#ffffff", 0.15 "#e8eef4", 0.4 "#9fc4de", 0.65 "#3a7fbb", 0.82 "#5b2a86", 1 "#c8201e")
set multiplot title heading offset 0, -0.4
set lmargin at screen (frequency_end >= 1e4 ? 0.095 : 0.085)
set rmargin at screen 0.9
set xrange [frequency_from : frequency_to]
top(y) = 1 - y * (1 - lift)
# a: spectrogram, with the speed of the driver above
set tmargin at screen top(0.135)
set bmargin at screen top(0.475)
in_hertz = speed_scale == 1
other = in_hertz ? rpm_per_hertz : 1 / speed_scale
set x2range [frequency_from * other : frequency_to * other]
set x2tics out
set x2label (in_hertz ? "Speed of " . driver . " (rpm)" : "Mesh frequency (Hz)") offset 0, 0.3
f_n = natural_frequency / speed_scale
set format x ""
set ylabel "Frequency (Hz) {/:Bold (a)}" offset (frequency_end >= 1e4 ? 0.9 : 1.6), 0
set yrange [0 : frequency_end]
set cbrange [loudest - 60 : loudest]
set cblabel "Mesh force (dB re 1 N RMS)" offset 0.9, 0
set colorbox user origin screen 0.912, top(0.475) size screen 0.012, top(0.135) - top(0.475)
set arrow 1 from graph 0, first f_n to graph 1, first f_n nohead front lt 1 lw 1.2 dt (16, 10) lc rgb "#202020"
set label 1 "f_n" at graph 0.985, first f_n offset 0, -0.7 right front tc rgb "#202020" font ",15"
do for [k = 1:4] {
  if (k * frequency_to / speed_scale < frequency_end) { set label 10 + k sprintf("%d", k) at first frequency_to, first k * frequency_to / speed_scale offset -1.2, 0.9 front tc rgb "#202020" font ",15" }
}
# What is white is left out: nine tenths of the file.
plot tsv index "[spectrogram]" using 1:2:($3 > loudest - 60 ? $3 : NaN) with image pixels notitle
unset arrow
unset label
unset x2tics
unset x2label
unset colorbox

# b: orders
set grid lt 1 lc rgb "#e4e4e4" lw 1
set tmargin at screen top(0.50)
set bmargin at screen top(0.74)
set ylabel (level_label eq "" ? "Amplitude of DTE (µm)" : "DTE (" . level_label . ")") . " {/:Bold (b)}" offset 0.5, 0
peak = largest > largest_sweep ? largest : largest_sweep
if (level_label eq "") { set yrange [0 : 1.08 * peak] } else { set yrange [level_low - 0.25 * (level_high - level_low) : level_high] }
if (level_label eq "") { set key top left Left reverse samplen 2 spacing 1.1 font ",15" } else { set key bottom left horizontal Left reverse samplen 2 spacing 1.1 font ",15" }
drawn = ""
do for [k = 1:int(sweeps)] {
  drawn = drawn . sprintf('tsv index "[sweep %s]" using 1:2 with points pt %d ps 0.55 lc rgb "%s" title "order 1, sweep %s", ', value(sprintf("sweep%d", k)), k == 1 ? 7 : 6, "#909090", value(sprintf("sweep%d", k)))
}
do for [k = 1:int(orders)] { drawn = drawn . sprintf('tsv index "[orders]" using 2:%d with lines lt 1 lw 2.2 lc rgb "%s" title "order %d", ', k + 2, colour[k], k) }
eval("plot " . drawn . "NaN notitle")

# c: loads and contact
set tmargin at screen top(0.77)
set bmargin at screen top(0.93)
set format x "%g"
set xlabel speed_label
set ylabel "Load / mean {/:Bold (c)}" offset 0.5, 0
set ytics 1
set key top right vertical Right noreverse
set yrange [0 : 1.4 * largest_load]
set y2range [0 : 100]
set y2tics 25 out
set border 11
set y2label "Without contact (%)" offset -0.8, 0
plot tsv index "[periods]" using 1:2 with lines lt 1 lw 1.8 lc rgb colour[1] title "largest load of a tooth, over mean mesh force", \
     tsv index "[periods]" using 1:3 axes x1y2 with filledcurves y2=0 fs transparent solid 0.35 noborder lc rgb colour[2] title "share of the period without contact"
eval(below)
unset multiplot
