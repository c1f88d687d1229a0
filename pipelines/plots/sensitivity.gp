# Sensitivity: what each variant of a scene changes, one panel of bars per response quantity.
# Variables from gear-plot: tsv, heading, note1, note2, variants, label1.., reach1..6: largest change of each response quantity
load plots . "/common.gp"
unset grid
set datafile separator whitespace
lift = room(2)
set multiplot title heading
set border 3 lw 1.4
set grid xtics lt 1 lc rgb "#e4e4e4" lw 1
set style fill solid 0.9 noborder
# The keys of a variant that two gears have in turn, a line each.
two_lines(s) = strstrt(s, "; ") > 0 ? s[1:strstrt(s, "; ")] . "\n" . s[strstrt(s, "; ") + 2:*] : s
set yrange [variants - 0.4:-0.6]
set xtics font ",11.5"
array column_of[6] = [2, 3, 4, 5, 6, 7]
array name[6] = ["mean stiffness (%)", "f, one pair (Hz)", "f, two pairs (Hz)", "branches from (Hz)", "branches to (Hz)", "tooth load (%)"]
left = 0.33
width = (0.99 - left) / 6
set tmargin at screen 0.855 + lift
set bmargin at screen 0.12 + lift
do for [k = 1:6] {
  set lmargin at screen left + (k - 1) * width
  set rmargin at screen left + k * width - 0.02
  set xlabel name[k] font ",12.5"
  unset ytics
  if (k == 1) { set ytics nomirror scale 0 noenhanced font ",12" ("" 0); do for [i = 1:int(variants)] { set ytics add (two_lines(value(sprintf("label%d", i))) i - 1) } }
  reach = 1.12 * value(sprintf("reach%d", k))
  set xrange [-reach:reach]
  set xtics autofreq
  power = 10 ** floor(log10(reach))
  set xtics power * (reach / power > 5 ? 5 : reach / power > 2 ? 2 : 1)
  set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 1.4 lc rgb "#505050" front
  v = column_of[k]
  plot tsv index "[changes]" using (0.5 * column(v)):1:(0.5 * abs(column(v))):(0.36) with boxxyerror \
      lc rgb "#0072b2" notitle, \
    tsv index "[changes]" using ((v == 5 || v == 6) && $8 == 0 ? 0 : NaN):1 with points pt 2 ps 1.6 lw 2.4 lc rgb "#d55e00" notitle, \
    tsv index "[changes]" using (v == 5 && $8 > 0 && $9 > 0 ? column(v) : NaN):1 with points pt 8 ps 1.8 lw 2 lc rgb "#000000" notitle
}
eval(below)
unset multiplot
