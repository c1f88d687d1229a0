# A system at rest: transmission errors, mesh forces, bearing forces, each over a mesh period, of teeth that differ over the hunting period (left) and its harmonics (right).
# Variables from gear-plot: tsv, heading, line1.., height, harmonics, periods and, of each row k, quantity1.., axis1.., unit1.., labels1.., curves1..,
# low1.., high1.., most1..; notes, their number.
load plots . "/common.gp"

foot_name = "line%d"
lift = room(notes)

set multiplot title heading offset 0, -0.4
of(i) = colour[(i - 1) % 6 + 1]
dashes(i) = i > 6 ? "(10, 5)" : "solid"
row = ((1 - lift) * height - 100) / 3
do for [k = 1:3] {
  quantity = value(sprintf("quantity%d", k))
  axis = value(sprintf("axis%d", k))
  unit = value(sprintf("unit%d", k))
  labels = value(sprintf("labels%d", k))
  bottom = value(sprintf("low%d", k))
  top = value(sprintf("high%d", k))
  largest = value(sprintf("most%d", k))
  curves = int(value(sprintf("curves%d", k)))
  # Curves lie on each other where meshes are alike: what is drawn first shows on either side of what is drawn on it.
  thick(i) = periods > 1 ? 1.2 : 2 + 0.8 * (curves - i)
  set tmargin at screen 1 - (112.0 + row * (k - 1)) / height
  set bmargin at screen 1 - (row + 5.0 + row * (k - 1)) / height
  set lmargin at screen 0.1
  set rmargin at screen 0.485
  set xlabel "Mesh phase (mesh periods)" offset 0, 0.3
  set ylabel sprintf("%s (%s)", axis, unit)
  set xrange [0:periods]
  set yrange [bottom : top]
  if (periods == 1) { set xtics 0.2 } else { set xtics autofreq }
  unset key
  drawn = ""
  do for [i = 1:curves] {
    drawn = drawn . (i > 1 ? ", " : "") . sprintf('tsv index "[%s]" using 1:%d with lines lt 1 dt %s lw %g lc rgb "%s"', \
      quantity, i + 1, dashes(i), thick(i), of(i))
  }
  eval("plot " . drawn)

  set lmargin at screen 0.59
  set rmargin at screen 0.83
  set xlabel "Harmonic of the mesh frequency" offset 0, 0.3
  set ylabel sprintf("Amplitude (%s)", unit)
  set xrange [0.4 : harmonics + 0.6]
  set yrange [0 : largest]
  set xtics 1
  set key at graph 1.03, graph 1.02 left top Left reverse vertical samplen 2 spacing 1.2 font ",13" noenhanced
  drawn = ""
  step = 0.8 / curves
  do for [i = 1:curves] {
    drawn = drawn . (i > 1 ? ", " : "") . sprintf('tsv index "[%s harmonics]" using ($1 + %g):%d with impulses lt 1 lw 3 lc rgb "%s" notitle, ', \
      quantity, (i - 0.5 * (curves + 1)) * step, i + 1, of(i)) \
      . sprintf('keyentry with lines lt 1 dt %s lw 3 lc rgb "%s" title word(labels, %d)', dashes(i), of(i), i)
  }
  eval("plot " . drawn)
}
eval(below)
unset multiplot
