// Panels in gnuplot's words, for pipelines/plots/panels.gp.
#pragma once
#include <string>

#include "report/figures.h"

namespace whine {

// A picture of panels, laid out by panel_layout.h.
struct PanelPicture {
  int height = 0;      // pixels
  std::string script;  // variables panels, panel1, ...: commands that draw each
};

// Throws Error(numerical) for a curve whose block or column the figure does not have.
PanelPicture panel_picture(const Figure& figure);

}  // namespace whine
