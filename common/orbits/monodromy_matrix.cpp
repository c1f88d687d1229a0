#include "orbits/monodromy_matrix.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

constexpr int kWholeState = 8;  // numbers of a state, up to which all directions are kept
constexpr int kSlowDirections =
    8;  // kept of longer states at first; more as long as the least is not forgotten
constexpr double kForgotten = 0.2;  // multiplier that is left to Picard's iteration

// Orthonormal (size, count): `first` unless it is empty, then the largest columns of m, by Gram and Schmidt with column pivots,
// twice; filled up with fixed directions.
MatrixXd orthonormal(const VectorXd& first, MatrixXd m, Index size, Index count) {
  MatrixXd q(size, count);
  Index rank = 0;
  const auto take = [&](VectorXd column) {
    const double before = column.norm();
    for (int twice = 0; twice < 2; ++twice)
      column -= q.leftCols(rank) * (q.leftCols(rank).transpose() * column);
    constexpr double kNothing = 1e-10;
    if (!(column.norm() > kNothing * before)) return;
    q.col(rank++) = column / column.norm();
  };
  if (first.size() > 0) take(first);
  if (m.cols() > 0) {
    m -= q.leftCols(rank) * (q.leftCols(rank).transpose() * m).eval();
    const double least = 1e-13 * m.colwise().norm().maxCoeff();
    for (Index k = 0; k < m.cols() && rank < count; ++k) {
      Index pivot;
      if (!(m.colwise().norm().maxCoeff(&pivot) > least)) break;
      const Index before = rank;
      take(m.col(pivot));
      if (rank > before) m -= q.col(before) * (q.col(before).transpose() * m).eval();
      m.col(pivot).setZero();
    }
  }
  for (int which = 0; rank < count; ++which)
    take(VectorXd::NullaryExpr(
        size, [&](Index i) { return std::sin(1.0 + 2.3 * static_cast<double>(i) * (which + 1) + which); }));
  return q;
}

}  // namespace

VectorXcd MonodromyMatrix::multipliers() const {
  const GeneralEigenvalues found = general_eigenvalues(basis.transpose() * image);
  if (!found.converged)
    fail(Failure::numerical, "the multipliers of an orbit of ", basis.rows(), " numbers were not found");
  VectorXcd values = found.values;
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return values;
}

MonodromyMatrix slow_tangent(int size, const MonodromyMatrix& nearby, const VectorXd& also, double tolerance,
                             const std::function<MatrixXd(const MatrixXd&)>& times) {
  MonodromyMatrix t;
  const auto take_all = [&] {
    t.basis = MatrixXd::Identity(size, size);
    t.image = times(t.basis);
  };
  if (size <= kWholeState) {
    take_all();
    return t;
  }
  constexpr int kMost = 60, kWidenings = 4;
  Index count = nearby.empty() ? std::min(kSlowDirections, size) : nearby.basis.cols();
  t.basis = orthonormal(also, nearby.image, size, count);
  double residual = 0;
  int waited = 0;  // iterations since it grew
  for (int i = 0, widenings = 0;; ++i) {
    // The cut may go through multipliers of one modulus, as a gear's double modes have them: there no number of iterations settles
    // it, but it does behind them.
    if (i == kMost) {
      // Damping by mass gives all modes one modulus: nothing is behind them.
      if (widenings++ == kWidenings || count == size) {
        take_all();
        return t;
      }
      count = std::min<Index>(count + kSlowDirections, size);
      t.basis = orthonormal(also, t.image, size, count);
      i = waited = 0;
    }
    t.image = times(t.basis);
    // Of the eigenvectors, each weighted by a power of its multiplier.
    const MatrixXd h = t.basis.transpose() * t.image, h2 = h * h, h4 = h2 * h2;
    const double weight = h4.norm();
    residual = weight > 0 ? ((t.image - t.basis * h) * h4).norm() / weight : 0;
    const VectorXcd values = t.multipliers();
    const bool wide = count == size || std::abs(values[count - 1]) < kForgotten;
    if (wide && !(residual > tolerance)) return t;
    // Of many multipliers of about one modulus a subspace takes in some directions and leaves others out: it does not settle, and the
    // least of its own multipliers says nothing.
    constexpr double kSettled = 0.1;
    constexpr int kPatience = 5;
    const bool unsettled = ++waited >= kPatience && !(residual < kSettled);
    if ((!wide && residual < kSettled) || unsettled) {
      count = std::min<Index>(count + kSlowDirections, size);
      waited = 0;
    }
    t.basis = orthonormal(also, t.image, size, count);
  }
}

}  // namespace whine
