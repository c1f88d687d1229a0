#include "results/error_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whine {

RootConvergence convergence(const RootRefinement& root) {
  const Eigen::Index changes = std::max<Eigen::Index>(root.stress.rows() - 1, 0), gears = root.stress.cols();
  RootConvergence out;
  out.change.resize(changes, gears);
  out.order.resize(std::max<Eigen::Index>(changes - 1, 0), gears);
  for (Eigen::Index g = 0; g < gears; ++g) {
    for (Eigen::Index k = 0; k < changes; ++k)
      out.change(k, g) = (root.stress(k + 1, g) - root.stress(k, g)) / root.stress(changes, g);
    for (Eigen::Index k = 0; k + 1 < changes; ++k) {
      const double before = std::abs(out.change(k, g)), after = std::abs(out.change(k + 1, g));
      out.order(k, g) =
          before > 0 && after > 0
              ? std::log(before / after) / std::log(root.element_size[k] / root.element_size[k + 1])
              : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return out;
}

double resolved_order(const RootConvergence& root, Eigen::Index k, Eigen::Index gear) {
  const bool told = root.change.col(gear).segment(k, 2).cwiseAbs().minCoeff() > kOrderlessChange;
  return told ? root.order(k, gear) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace whine
