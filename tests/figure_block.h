// The block of a figure that has this name; what stands in the key of a panel.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "report/figures.h"

namespace whine {

inline const FigureBlock& block(const Figure& figure, const std::string& name) {
  for (const FigureBlock& b : figure.blocks)
    if (b.name == name) return b;
  FAIL("no block " << name);
  return figure.blocks.front();
}

inline bool has_label(const Panel& panel, const std::string& label) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [&](const PanelCurve& c) { return c.label == label; });
}

}  // namespace whine
