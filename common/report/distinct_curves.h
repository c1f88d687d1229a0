// Curves of a panel that lie on each other: planets that are alike, and do the same.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "report/panels.h"

namespace whine {

// [curve] its number among those that differ, in the order of the first of each: 0 1 0 1 of four planets of which opposite ones are
// alike. span: of the axis; two curves that differ by less than the width of a line at each point lie on each other.
std::vector<size_t> distinct_curves(const std::vector<Eigen::VectorXd>& curves, double span);

// How many differ; whether a curve is the first of those on which it lies, and so is the one that is drawn.
size_t count_of_distinct(const std::vector<size_t>& numbers);
bool is_first(const std::vector<size_t>& numbers, size_t i);

// The note of a figure that has such curves.
inline constexpr const char* kOneColour = "curves of one colour and dash in a key lie on each other";

}  // namespace whine
