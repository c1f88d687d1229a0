// How the figure of work and precision is drawn.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "report/figures.h"

namespace whine {

// Of a figure with blocks of {setting, CPU (s), error (%), bound (%)}: first those of accepted errors (%: their setting), then those of
// single settings, then "chosen" and "scene", of a point each. A front below the dashed line keeps what is accepted.
inline void add_work_precision_panel(Figure& figure) {
  constexpr std::array kMarks{7, 5, 9, 11, 13, 2, 8};
  constexpr std::array kColours{kBlue, kVermilion, kGreen, kOrange, kPurple, kDark, kGrey};
  Panel panel{.x = {.label = "CPU of meshes, reductions, statics and sweep (s)", .log = true},
              .y = {.label = "Largest error of the RMS (%)", .log = true},
              .key = PanelKey::below,
              .height = 560};
  double least = 1e9, most = 0;
  for (size_t i = 0; i < figure.blocks.size(); ++i) {
    const FigureBlock& block = figure.blocks[i];
    const bool single = i + 2 >= figure.blocks.size();
    panel.curves.push_back(
        {.block = block.name,
         .x = 2,
         .y = 3,
         .style = single ? PanelStyle::points : PanelStyle::line_points,
         .colour = single ? kBlack : kColours.at(i % kColours.size()),
         .label = block.name,
         .width = i == 0 ? 3.0 : 1.5,
         .mark = single ? (i + 1 == figure.blocks.size() ? 4 : 6) : kMarks.at(i % kMarks.size()),
         .size = single ? 2.6 : 1.3});
    for (const auto& row : block.rows) {
      least = std::min(least, row[2]);
      most = std::max(most, row[2]);
    }
  }
  const FigureBlock& front = figure.blocks.front();
  for (const auto& row : front.rows) {
    panel.words.push_back({text(shown(row[0], 2), " %"), row[1], row[0]});
    most = std::max(most, row[0]);
  }
  panel.curves.push_back({.block = front.name,
                          .x = 2,
                          .y = 1,
                          .style = PanelStyle::line_points,
                          .colour = kGrey,
                          .label = "what is accepted",
                          .width = 1.5,
                          .dash = 2,
                          .mark = 6});
  panel.y.from = 0.5 * least;
  panel.y.to = 2 * most;
  figure.panels.push_back(panel);
}

}  // namespace whine
