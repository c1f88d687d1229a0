#include "results/error_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whine {

double order_of(double coarser_change, double finer_change, double ratio) {
  if (!(finer_change > 0)) return 0;
  const double order = std::log(coarser_change / finer_change) / std::log(ratio);
  return order >= 0.5 && order <= 6 ? order : 0;
}

double error_of(double change, double order, double ratio) {
  return std::abs(change) / (order > 0 ? 1 - std::pow(ratio, -order) : 1);
}

namespace {

double sum_of_errors(const Eigen::VectorXd& change, const Eigen::VectorXd& order) {
  double out = 0;
  for (Eigen::Index i = 0; i < change.size(); ++i)
    out += error_of(change[i], i < order.size() ? order[i] : 0);
  return out;
}

}  // namespace

double StaticChanges::error(const Eigen::VectorXd StaticChanges::*change) const {
  return sum_of_errors(this->*change, order);
}

double StaticChanges::harmonic_error(Eigen::Index n) const {
  return sum_of_errors(harmonic_change.col(n - 1), order);
}

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
