#include "contact/load_path.h"

#include <cmath>
#include <limits>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void LoadPath::pivot(int k) {
  const double p = table_(k, k);
  if (!(std::abs(p) > 0) || !std::isfinite(p))
    fail(Failure::numerical, "load path: pivot ", p, " at strip ", k, " after ", pivots_,
         " pivots; the compliance is not positive definite");
  column_ = table_.col(k) / p;
  const double constant = constant_[k], slope = slope_[k];
  const Eigen::Index n = table_.rows();
  // w_i = (T_ij - T_ik T_kj / T_kk) z_j + T_ik / T_kk w_k + t_i - T_ik t_k / T_kk
  for (Eigen::Index j = 0; j < n; ++j) {
    if (j == k) continue;
    const double row = table_(k, j);
    table_.col(j) -= row * column_;
    table_(k, j) = -row / p;
  }
  table_.col(k) = column_;
  table_(k, k) = 1 / p;
  constant_ -= constant * column_;
  slope_ -= slope * column_;
  constant_[k] = -constant / p;
  slope_[k] = -slope / p;
  touches_[k] = !touches_[k];
  ++pivots_;
}

void LoadPath::follow(const MatrixXd& a, const VectorXd& gap, const VectorXd& approach, const VectorXd& load,
                      Eigen::Ref<VectorXd> x) {
  const int n = static_cast<int>(gap.size());
  table_ = a;
  constant_ = gap;
  slope_ = approach;
  touches_.setConstant(n, false);
  force_.setZero(n);
  pivots_ = 0;
  const int most = 50 * n + 50;
  const double kNever = std::numeric_limits<double>::infinity();
  double at = -kNever;  // where the present piece begins
  for (Eigen::Index target = 0; target < load.size();) {
    // The next strip whose gap or force runs out.
    double next = kNever;
    int who = -1;
    for (int i = 0; i < n; ++i)
      if (slope_[i] > 0)
        if (const double where = constant_[i] / slope_[i]; where < next) {
          next = where;
          who = i;
        }
    next = std::max(next, at);  // round-off where strips come or go together
    const double rate = -(touches_.select(approach.array() * slope_.array(), 0.0)).sum(),
                 offset = (touches_.select(approach.array() * constant_.array(), 0.0)).sum();
    for (; target < load.size() && rate > 0; ++target) {
      const double where = (load[target] - offset) / rate;
      if (where > next) break;
      x[target] = where;
    }
    if (target == load.size()) break;
    if (who < 0 || pivots_ >= most)
      fail(Failure::numerical, "load path: ", load[target], " N is not reached after ", pivots_,
           " pivots of ", n, " strips");
    at = next;
    pivot(who);
  }
  const double end = x[load.size() - 1];
  force_ = touches_.select(constant_.array() - end * slope_.array(), 0.0).matrix();
  const VectorXd d = a * force_ + gap - end * approach;
  residual_ = 0;
  for (int i = 0; i < n; ++i)
    residual_ = std::max(residual_, touches_[i] ? std::max(std::abs(d[i]), -force_[i] * a(i, i)) : -d[i]);
  residual_ /= std::abs(end);
  if (!(residual_ <= 1e-9) || !x.allFinite())
    fail(Failure::numerical, "load path: the solution under ", load[load.size() - 1],
         " N leaves a residual of ", residual_, " of its approach ", end, " m after ", pivots_, " pivots");
}

}  // namespace whine
