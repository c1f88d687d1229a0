# Ring-down of a system: damping ratio over natural frequency of each mode, over the mesh phases; Rayleigh's damping alone; natural
# frequencies of rigid gears.
# Variables from gear-plot: tsv, heading, note1.., notes, from, to, most, rigid (1: there are some in the range).
load plots . "/common.gp"
lift = room(notes)

set multiplot title heading offset 0, -0.4
set lmargin at screen 0.09
set rmargin at screen 0.97
set tmargin at screen 0.77
set bmargin at screen 0.12 + lift
set xrange [from : to]
set yrange [0 : most]
set xlabel "Natural frequency (Hz)"
set ylabel "Damping ratio (%)"
set key at screen 0.09, screen 0.905 left top Left reverse horizontal maxcols 2 width 2 samplen 3 spacing 1.3 font ",14"
drawn = rigid == 1 ? 'tsv index "[rigid]" using 1:(0):(0):(most) with vectors nohead lt 1 lw 1.6 lc rgb "#b8b8b8" notitle, ' \
  . 'keyentry with lines lt 1 lw 1.6 lc rgb "#b8b8b8" title "natural frequencies of rigid gears on the mean mesh stiffness", ' : ""
eval("plot " . drawn . 'tsv index "[rayleigh]" using 1:2 with lines lt 1 lw 2 dt (12, 6) lc rgb "#d55e00" title "Rayleigh damping if it damped all that deforms", ' \
  . 'tsv index "[modes]" using 2:5:3:4:6:7 with xyerrorbars pt 7 ps 1.3 lw 1.8 lc rgb "#0072b2" title "decays: mean, range over the mesh phases", ' \
  . 'tsv index "[modes]" using 9:8 with points pt 6 ps 2.2 lw 1.6 lc rgb "#222222" title "eigenvalues, frozen contact: mean"')
eval(below)
unset multiplot
