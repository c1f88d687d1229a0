#include "orbits/periodic_orbit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

// Orthonormal columns that span those of m but for round-off, by Gram and Schmidt with column pivots, twice.
MatrixXd range(MatrixXd m) {
  constexpr double kNothing = 1e-15;  // of the largest column
  VectorXd size = m.colwise().norm();
  const double least = kNothing * size.maxCoeff();
  MatrixXd q(m.rows(), m.cols());
  Eigen::Index rank = 0;
  for (; rank < m.cols(); ++rank) {
    Eigen::Index pivot;
    if (!(size.maxCoeff(&pivot) > least)) break;
    VectorXd column = m.col(pivot);
    column -= q.leftCols(rank) * (q.leftCols(rank).transpose() * column);
    q.col(rank) = column / column.norm();
    m -= q.col(rank) * (q.col(rank).transpose() * m).eval();
    size = m.colwise().norm();
    size[pivot] = 0;
  }
  return q.leftCols(rank);
}

}  // namespace

// A motion forgets most of its state within a period: eigenvalues but 0 are those on the range.
VectorXcd sorted_multipliers(const MatrixXd& monodromy) {
  const MatrixXd q = range(monodromy);
  VectorXcd values = VectorXcd::Zero(monodromy.rows());
  if (q.cols() > 0) {
    const GeneralEigenvalues found = general_eigenvalues(q.transpose() * (monodromy * q));
    if (!found.converged)
      fail(Failure::numerical, "the multipliers of an orbit of ", monodromy.rows(),
           " numbers were not found");
    values.head(q.cols()) = found.values;
  }
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return values;
}

VectorXcd PeriodicOrbit::multipliers() const {
  return sorted_multipliers(monodromy);
}

VectorXd image(PeriodMap& map, const VectorXd& y, int multiple, MatrixXd* tangent, PeriodicOrbit* passed) {
  if (passed) passed->events.clear();
  VectorXd at = y;
  for (int k = 0; k < multiple; ++k) {
    at = map.apply(at);
    if (tangent) {
      if (k == 0)
        *tangent = map.tangent();
      else
        *tangent = map.tangent() * *tangent;
    }
    if (!passed) continue;
    for (ContactEvent event : map.events()) {
      event.phase += k;
      passed->events.push_back(event);
    }
    const VectorXd observable = map.observable();
    passed->observable.conservativeResize(multiple * observable.size());
    passed->observable.segment(k * observable.size(), observable.size()) = observable;
  }
  return at;
}

OrbitSearch find_orbit(PeriodMap& map, const VectorXd& start, int multiple, const OrbitSettings& settings) {
  OrbitSearch search;
  PeriodicOrbit& orbit = search.orbit;
  orbit.start = start;
  orbit.parameter = map.parameter();
  orbit.multiple = multiple;
  orbit.residual = std::numeric_limits<double>::infinity();
  constexpr int kMostHalvings = 8;
  const auto size = [](const VectorXd& y, const VectorXd& change) {
    return change.norm() / std::max(1.0, y.norm());
  };
  try {
    VectorXd change = image(map, orbit.start, multiple) - orbit.start;
    orbit.residual = size(orbit.start, change);
    double before = std::numeric_limits<double>::infinity();
    for (;; ++orbit.iterations) {
      if (!std::isfinite(orbit.residual)) {
        search.failure = text("the residual is no number after ", orbit.iterations, " steps");
        return search;
      }
      const bool met = orbit.residual <= settings.tolerance,
                 stuck = orbit.residual <= 1e3 * settings.tolerance && !(orbit.residual < 0.5 * before);
      if (met || stuck) {
        image(map, orbit.start, multiple, &orbit.monodromy, &orbit);
        return search;
      }
      if (orbit.iterations == settings.most_iterations) {
        search.failure = text("no convergence in ", orbit.iterations, " steps: residual ", orbit.residual);
        return search;
      }
      before = orbit.residual;
      image(map, orbit.start, multiple, &orbit.monodromy);
      const VectorXd step =
          (MatrixXd::Identity(map.size(), map.size()) - orbit.monodromy).partialPivLu().solve(change);
      double share = 1;
      for (int halving = 0;; ++halving, share *= 0.5) {
        const VectorXd tried = orbit.start + share * step;
        double residual = std::numeric_limits<double>::infinity();
        VectorXd next;
        try {
          next = image(map, tried, multiple) - tried;
          residual = size(tried, next);
        } catch (const Error& error) {
          if (error.kind() != Failure::numerical || halving == kMostHalvings) throw;
        }
        // Near round-off a step need not gain anything.
        if (residual < before ||
            (before <= 1e3 * settings.tolerance && residual <= 1e3 * settings.tolerance)) {
          orbit.start = tried;
          orbit.residual = residual;
          change = next;
          break;
        }
        if (halving == kMostHalvings) {
          search.failure = text("no step of Newton's method brings the residual ", before, " down after ",
                                orbit.iterations, " steps");
          return search;
        }
      }
    }
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    search.failure = text("residual ", orbit.residual, " after ", orbit.iterations, " steps: ", error.what());
  }
  return search;
}

}  // namespace whine
