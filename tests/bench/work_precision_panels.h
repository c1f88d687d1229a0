// How the figure of work and precision is drawn.
#pragma once
#include <array>
#include <cmath>

#include "report/figures.h"

namespace whine {

// Of a figure whose first `axes` blocks are choices and whose block "scene" holds the scene's settings: a panel for each observable, in
// columns 5 to 9 against the CPU time in column 2. fold_width: Hz, to which ends of branches are known.
inline void add_work_precision_panels(size_t axes, double fold_width, Figure& figure) {
  constexpr double kLeast = 1e-8;
  constexpr std::array kObservables{"RMS, relative error", "mean, error / static deflection",
                                    "peak tooth load, relative error", "jump, speed falling, error (Hz)",
                                    "jump, speed rising, error (Hz)"};
  constexpr std::array kMarks{7, 6, 5, 9, 11, 13, 4, 8, 2};
  constexpr std::array kColours{kBlue, kPale, kVermilion, kGreen, kOrange, kPurple, kDark, kGrey, kBlack};
  for (size_t o = 0; o < kObservables.size(); ++o) {
    const int column = 5 + static_cast<int>(o);
    Panel panel{.x = {.label = "CPU (s)", .log = true},
                .y = {.label = kObservables[o], .log = true},
                .key = o + 1 == kObservables.size() ? PanelKey::below : PanelKey::none,
                .height = 300};
    double largest = 0;
    for (size_t i = 0; i < axes; ++i) {
      panel.curves.push_back({.block = figure.blocks[i].name,
                              .x = 2,
                              .y = column,
                              .style = PanelStyle::line_points,
                              .colour = kColours.at(i),
                              .label = figure.blocks[i].name,
                              .width = 2,
                              .mark = kMarks.at(i),
                              .size = 1.3});
      for (const auto& row : figure.blocks[i].rows)
        largest = std::max(largest, row[static_cast<size_t>(column - 1)]);
    }
    panel.curves.push_back({.block = "scene",
                            .x = 2,
                            .y = column,
                            .style = PanelStyle::points,
                            .colour = kBlack,
                            .label = "the scene's settings",
                            .width = 1.5,
                            .mark = 6,
                            .size = 2.4});
    panel.y.from = o < 3 ? kLeast : fold_width;
    panel.y.to = std::max(10 * panel.y.from, 2 * largest);
    figure.panels.push_back(panel);
  }
  figure.columns = 3;
}

}  // namespace whine
