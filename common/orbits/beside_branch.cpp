// Beside a branch: orbits that it comes through, orbits of twice the periods beyond a flip, a fold by Newton's method.
#include "orbits/branch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "orbits/curve.h"

namespace whine {

using Eigen::VectorXd;

bool passes(const BranchPosition& last, const BranchPosition& next, const VectorXd& start, double parameter,
            double scale) {
  constexpr double kBeside = 0.15;  // of the chord
  if (start.size() != last.start.size() || start.size() != next.start.size()) return false;
  const auto from_last = [&](const VectorXd& y, double at) {
    VectorXd u(y.size() + 1);
    u << y - last.start, (at - last.parameter) / scale;
    return u;
  };
  const VectorXd chord = from_last(next.start, next.parameter), way = from_last(start, parameter);
  const double share = way.dot(chord) / chord.squaredNorm();
  return share > 0 && share <= 1 && (way - share * chord).norm() < kBeside * chord.norm();
}

bool becomes_half(const BranchPosition& last, const BranchPosition& next) {
  const auto halves = [](const VectorXd& x) -> VectorXd {
    return x.head(x.size() / 2) - x.tail(x.size() / 2);
  };
  return last.observable.size() == next.observable.size() &&
         halves(last.observable).dot(halves(next.observable)) < 0;
}

OrbitSearch orbit_beyond_flip(PeriodMap& map, const SpecialPoint& flip, int multiple, double scale,
                              double distance) {
  OrbitSearch search;
  const int n = map.size();
  try {
    map.set_parameter(flip.parameter);
    const OrbitSearch at = newton_orbit(map, flip.start, multiple);
    if (!at.found()) {
      search.failure = "at the flip: " + at.failure;
      return search;
    }
    // The eigenvector W c of -1, (V^T W + 1) c = 0, by inverse iteration.
    const MonodromyMatrix& slow = at.orbit.slow;
    const auto p = slow.basis.cols();
    constexpr double kBeside = 1e-7;  // of the eigenvalue, so that the matrix can be solved with
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(slow.basis.transpose() * slow.image +
                                                  (1 + kBeside) * Eigen::MatrixXd::Identity(p, p));
    VectorXd c = VectorXd::Ones(p);
    for (int i = 0; i < 4; ++i) c = lu.solve(c).normalized();
    VectorXd across = VectorXd::Zero(n + 1);
    across.head(n) = (slow.image * c).normalized();
    Curve curve(map, 2 * multiple, scale, {});
    const VectorXd from = curve.point(at.orbit.start, flip.parameter);
    auto point = curve.correct(from + distance * across, across, nullptr);
    if (!point) {
      search.failure = "no orbit of twice the periods beside the flip: " + curve.failure();
      return search;
    }
    map.set_parameter(curve.parameter(point->u));
    search = newton_orbit(map, curve.state(point->u), 2 * multiple);
    if (search.found() &&
        (image(map, search.orbit.start, multiple) - search.orbit.start).norm() < 0.1 * distance)
      search.failure = "beside the flip only the orbit itself is found";
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    search.failure = error.what();
  }
  return search;
}

FoldSearch locate_fold(PeriodMap& map, const VectorXd& start, int multiple, double scale) {
  FoldSearch search;
  Curve curve(map, multiple, scale, {});
  MonodromyMatrix slow;
  PeriodicOrbit passed;
  const auto jacobian_at = [&](const VectorXd& at) {
    MonodromyMatrix found;
    CurveJacobian jacobian = curve.jacobian(at, slow, found, passed);
    slow = std::move(found);
    return jacobian;
  };
  const int n = map.size();
  VectorXd u = curve.point(start, map.parameter());
  VectorXd across = VectorXd::Constant(n + 1, 1 / std::sqrt(n + 1.0));
  const auto tangent_at = [&](const VectorXd& at) { return jacobian_at(at).tangent(across); };
  try {
    across = tangent_at(u);
    double last = std::numeric_limits<double>::infinity();
    constexpr int kMost = 40;
    for (int i = 0; i < kMost; ++i) {
      const VectorXd value = curve.residual(u), back = jacobian_at(u).solve(across, -value, 0);
      u += back;
      const VectorXd t = tangent_at(u);
      across = t;
      // The turn of the tangent per arc, at points off the curve by its square only.
      constexpr double kStep = 1e-5;
      const double rate = (tangent_at(u + kStep * t)[n] - tangent_at(u - kStep * t)[n]) / (2 * kStep);
      constexpr double kFarthest = 0.05;
      const double along = std::clamp(-t[n] / rate, -kFarthest, kFarthest);
      if (!u.allFinite() || !std::isfinite(along)) {
        search.failure = "the tangent does not turn";
        return search;
      }
      u += along * t;
      const double size = std::hypot(back.norm(), along);
      if (size < 1e-12 || (size < 1e-8 && size > 0.5 * last)) {
        search.start = u.head(n);
        search.parameter = curve.parameter(u);
        map.set_parameter(search.parameter);
        return search;
      }
      last = size;
    }
    search.failure = text("no convergence: the last step was ", last);
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    search.failure = error.what();
  }
  return search;
}

}  // namespace whine
