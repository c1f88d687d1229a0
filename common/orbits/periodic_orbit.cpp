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

VectorXd image(PeriodMap& map, const VectorXd& y, int multiple, PeriodicOrbit* passed, MatrixXd* directions) {
  if (passed) passed->events.clear();
  VectorXd at = y;
  for (int k = 0; k < multiple; ++k) {
    at = map.apply(at);
    if (directions) *directions = map.tangent_times(*directions);
    if (!passed) continue;
    for (ContactEvent event : map.events()) {
      event.phase += k;
      passed->events.push_back(event);
    }
    const VectorXd observable = map.observable();
    passed->observable.conservativeResize(multiple * observable.size());
    passed->observable.segment(k * observable.size(), observable.size()) = observable;
    passed->peaks = map.peaks(k, multiple);
  }
  return at;
}

namespace {

// The tangent of P^m at y, and what happens on the way.
MonodromyMatrix tangent_at(PeriodMap& map, const VectorXd& y, int multiple, const MonodromyMatrix& nearby,
                           PeriodicOrbit* passed) {
  constexpr double kTolerance = 1e-8;  // of multipliers
  bool applied = false;
  return slow_tangent(map.size(), nearby, {}, kTolerance, [&](const MatrixXd& directions) {
    MatrixXd moved = directions;
    if (applied && multiple == 1)
      moved = map.tangent_times(directions);
    else
      image(map, y, multiple, passed, &moved);
    applied = true;
    return moved;
  });
}

// (1 - W V^T)^-1 change
VectorXd newton_step(const MonodromyMatrix& t, const VectorXd& change) {
  const Eigen::Index p = t.basis.cols();
  const MatrixXd small = MatrixXd::Identity(p, p) - t.basis.transpose() * t.image;
  return change + t.image * lu_solve(small, t.basis.transpose() * change);
}

}  // namespace

OrbitSearch newton_orbit(PeriodMap& map, const VectorXd& start, int multiple, const OrbitSettings& settings) {
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
        orbit.slow = tangent_at(map, orbit.start, multiple, orbit.slow, &orbit);
        return search;
      }
      if (orbit.iterations == settings.most_iterations) {
        search.failure = text("no convergence in ", orbit.iterations, " steps: residual ", orbit.residual);
        return search;
      }
      constexpr double kSlow = 0.3;  // reduction of the residual, above which the tangent is computed anew
      if (orbit.slow.empty() || orbit.slow.whole() || !(orbit.residual < kSlow * before))
        orbit.slow = tangent_at(map, orbit.start, multiple, orbit.slow, nullptr);
      before = orbit.residual;
      const VectorXd step = newton_step(orbit.slow, change);
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
