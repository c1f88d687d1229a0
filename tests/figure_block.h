// The block of a figure that has this name.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "report/figures.h"

namespace whine {

inline const FigureBlock& block(const Figure& figure, const std::string& name) {
  for (const FigureBlock& b : figure.blocks)
    if (b.name == name) return b;
  FAIL("no block " << name);
  return figure.blocks.front();
}

}  // namespace whine
