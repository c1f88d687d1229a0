// Lines of equal value over a grid, as a block of a figure, with a number on each.
#pragma once
#include <string>
#include <vector>

#include "base/matrix.h"
#include "report/figures.h"

namespace whine {

// Edges of cells about their middles: between neighbours, and as far beyond the ends; of one middle half a unit to either side.
std::vector<double> cell_edges(const std::vector<double>& middle);

struct LevelLines {
  FigureBlock lines;  // x, y in the columns given: pieces of lines, a row of nothing between two
  std::vector<PanelWords>
      numbers;  // on each level, where it passes nearest to three quarters of x and not at an edge
};

// value: (y, x) on ascending x and y, linear in the two triangles of each cell. Levels: multiples of a step of 1, 2 or 5 times a power of ten,
// about `count` of them, above 0.
LevelLines level_lines(const std::string& block, const std::vector<std::string>& columns,
                       const Eigen::VectorXd& x, const Eigen::VectorXd& y, const MatrixRM& value, int count);

}  // namespace whine
