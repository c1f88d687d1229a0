# Profile charts: material on the driving flanks against the roll angle, tip to the right, one panel per gear.
# Variables from gear-plot: tsv, heading, title_driver, title_driven, lowest, highest; for each gear g: form_g, sap_g, lpstc_g,
# pitch_g, hpstc_g, tip_g.
load plots . "/common.gp"
foot1 = "thin line: the involute without modification; form: where the involute begins; SAP: start of the active profile"
foot2 = "LPSTC, HPSTC: lowest and highest point of single tooth contact (B, D of the driver; D, B of the driven gear)"
foot_name = "foot%d"
lift = room(2)

set multiplot layout 2, 1 title heading offset 0, -0.3 margins screen 0.11, 0.975, 0.1 + lift, 0.79 + lift spacing screen 0.185
set mxtics 5
set mytics 2
set ylabel "Material (µm)"
span = highest - lowest > 0 ? highest - lowest : 1
set yrange [lowest - 0.12 * span : highest + 0.42 * span]
unset key
set style textbox opaque noborder margins 0.3, 0.2
do for [g in "driver driven"] {
  set title value("title_" . g) offset 0, 0.2
  set xlabel "Roll angle (deg)"
  from = value("form_" . g)
  to = value("tip_" . g)
  set xrange [from - 0.02 * (to - from) : to + 0.02 * (to - from)]
  unset arrow
  unset label
  n = 0
  do for [m in "form sap lpstc pitch hpstc tip"] {
    n = n + 1
    x = value(m . "_" . g)
    set arrow n from x, graph 0 to x, graph 1 nohead back lw 1.4 dt (8, 6) lc rgb "#808080"
    # Two rows, since the pitch point may stand close to an end of single tooth contact, and SAP to the form point.
    set label n m eq "sap" || m eq "lpstc" || m eq "hpstc" ? (m eq "sap" ? "SAP" : m eq "lpstc" ? "LPSTC" : "HPSTC") : m \
      at x, graph (m eq "pitch" || m eq "form" ? 0.86 : 0.95) offset 0.5, 0 left boxed front font ",13" tc rgb "#505050"
  }
  set arrow 20 from from, 0 to to, 0 nohead back lw 1.6 lc rgb "#1a7f37"
  plot sprintf("%s", tsv) index "[" . g . "]" using 1:3 with lines lw 3 lc rgb "#1f4e9c"
}
eval(below)
unset multiplot
