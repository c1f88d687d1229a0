#include "report/distinct_curves.h"

#include <algorithm>

namespace whine {

std::vector<size_t> distinct_curves(const std::vector<Eigen::VectorXd>& curves, double span) {
  constexpr double kLine = 0.01;  // of a panel's height
  std::vector<size_t> first, out;
  out.reserve(curves.size());
  for (size_t i = 0; i < curves.size(); ++i) {
    const auto found = std::find_if(first.begin(), first.end(), [&](size_t f) {
      return (curves[f] - curves[i]).cwiseAbs().maxCoeff() <= kLine * span;
    });
    out.push_back(static_cast<size_t>(found - first.begin()));
    if (found == first.end()) first.push_back(i);
  }
  return out;
}

size_t count_of_distinct(const std::vector<size_t>& numbers) {
  return numbers.empty() ? 0 : 1 + *std::max_element(numbers.begin(), numbers.end());
}

bool is_first(const std::vector<size_t>& numbers, size_t i) {
  return std::find(numbers.begin(), numbers.end(), numbers[i]) - numbers.begin() ==
         static_cast<std::ptrdiff_t>(i);
}

}  // namespace whine
