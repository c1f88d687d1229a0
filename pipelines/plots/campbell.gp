# Campbell diagram: natural frequencies (lines; bands over the mesh phases), harmonics of the mesh frequency, their crossings.
# Variables from gear-plot: tsv, heading, note1.., notes, highest, harmonics, bands, and how many modes are rotational, translational, planet,
# mixed, train; speed_label, speed_scale.
load plots . "/common.gp"
lift = room(notes)

array colour[5] = ["#0072b2", "#d55e00", "#009e73", "#555555", "#0072b2"]
array number[5] = [rotational, translational, planet, mixed, train]
kind = "rotational translational planet mixed modes"
set multiplot title heading offset 0, -0.4
set lmargin at screen 0.12
set rmargin at screen 0.80
set tmargin at screen 0.88
set bmargin at screen 0.11 + lift
top = 1.06 * highest
wide = top * speed_scale
set xrange [0 : wide]
set yrange [0 : top]
set xlabel speed_label
set ylabel "Frequency (Hz)"
set key at screen 0.82, screen 0.87 left top Left reverse vertical samplen 2 spacing 1.3 font ",14"
set style fill solid 0.22 noborder
do for [l = 1:int(harmonics)] {
  set label l sprintf("%d f_m", l) at (l == 1 ? 0.985 : 1.0 / l) * wide, (l == 1 ? 0.95 * top : top) offset 0, (l == 1 ? 0 : 0.6) center front tc rgb "#505050" font ",13"
}
drawn = ""
do for [k = 0:4] {
  if (number[k + 1] > 0) {
    if (bands == 1) {
      drawn = drawn . sprintf('tsv index "[frequencies]" using ($5 == %d ? 0.5 * wide : NaN):2:(0):(wide):3:4 with boxxyerror lc rgb "%s" notitle, ', k, colour[k + 1])
    }
    drawn = drawn . sprintf('tsv index "[frequencies]" using (0):($5 == %d ? $2 : NaN):(wide):(0) with vectors nohead lt 1 lw 2 lc rgb "%s" notitle, ', k, colour[k + 1]) \
      . sprintf('keyentry with lines lt 1 lw 2.4 lc rgb "%s" title "%s", ', colour[k + 1], word(kind, k + 1))
  }
}
eval("plot " . drawn . 'for [l = 1:int(harmonics)] l * x / speed_scale with lines lt 1 lw 1.2 dt (12, 6) lc rgb "#8a8a8a" notitle, ' \
  . 'keyentry with lines lt 1 lw 1.2 dt (12, 6) lc rgb "#8a8a8a" title "harmonics", ' \
  . 'tsv index "[crossings]" using 3:4 with points pt 7 ps 0.8 lc rgb "#222222" title "crossings"')
eval(below)
unset multiplot
