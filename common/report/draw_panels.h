// Panels in gnuplot's words, for pipelines/plots/panels.gp.
#pragma once
#include <string>

#include "report/figures.h"

namespace whine {

// A picture of panels, laid out so that no text meets another: widths of the numbers beside an axis, of keys and of lines of notes are
// measured (text_width.h).
struct PanelPicture {
  int height = 0;      // pixels
  std::string script;  // variables panels, panel1, ...: commands that draw each
};

// title_lines: of the heading. Throws Error(numerical) for a curve whose block or column the figure does not have.
PanelPicture panel_picture(const Figure& figure);

}  // namespace whine
