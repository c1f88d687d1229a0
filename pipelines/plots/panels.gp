# Panels of curves, marks and bars, as common/report/panels.h describes them: every figure without a template of its own.
# Variables from the program: tsv, heading, height, note1, ..., notes, panels, panel1, ...: commands that draw each.
load plots . "/common.gp"
lift = room(notes)
set style textbox opaque noborder margins 0.4, 0.2

set multiplot title heading offset 0, -0.4
do for [p = 1:panels] { eval(value(sprintf("panel%d", p))) }
eval(below)
unset multiplot
