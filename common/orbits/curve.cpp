#include "orbits/curve.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/model_range.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool same_sequence(const std::vector<ContactEvent>& a, const std::vector<ContactEvent>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.contact == y.contact && x.closes == y.closes;
         });
}

CurveJacobian::CurveJacobian(const MonodromyMatrix& tangent, const VectorXd& slope) {
  const Index n = slope.size(), p = tangent.basis.cols();
  left_.resize(n, p + 1);
  left_ << tangent.image, slope;
  right_ = MatrixXd::Zero(n + 1, p + 1);
  right_.topLeftCorner(n, p) = tangent.basis;
  right_(n, p) = 1;
}

void CurveJacobian::update(const VectorXd& du, const VectorXd& change) {
  const Index n = left_.rows(), q = left_.cols();
  const double squared = du.squaredNorm();
  if (!(squared > 0)) return;
  const VectorXd known = left_ * (right_.transpose() * du) - du.head(n);
  left_.conservativeResize(n, q + 1);
  right_.conservativeResize(n + 1, q + 1);
  left_.col(q) = (change - known) / squared;
  right_.col(q) = du;
}

// Of the unknowns a = Z^T du and the change of the parameter.
MatrixXd CurveJacobian::small(const VectorXd& across) const {
  const Index n = left_.rows(), q = left_.cols();
  MatrixXd s(q + 1, q + 1);
  s.topLeftCorner(q, q) = MatrixXd::Identity(q, q) - right_.topRows(n).transpose() * left_;
  s.topRightCorner(q, 1) = -right_.row(n).transpose();
  s.bottomLeftCorner(1, q) = across.head(n).transpose() * left_;
  s(q, q) = across[n];
  return s;
}

VectorXd CurveJacobian::solve(const VectorXd& across, const VectorXd& right, double last) const {
  const Index n = left_.rows(), q = left_.cols();
  VectorXd r(q + 1);
  r << -(right_.topRows(n).transpose() * right), last + across.head(n).dot(right);
  const VectorXd found = Eigen::PartialPivLU<MatrixXd>(small(across)).solve(r);
  VectorXd du(n + 1);
  du << left_ * found.head(q) - right, found[q];
  return du;
}

VectorXd CurveJacobian::tangent(const VectorXd& across) const {
  const VectorXd t = solve(across, VectorXd::Zero(left_.rows()), 1);
  return t / t.norm();
}

int CurveJacobian::sign(const VectorXd& across) const {
  const Eigen::PartialPivLU<MatrixXd> lu(small(across));
  int sign = static_cast<int>(lu.permutationP().determinant());
  for (Index i = 0; i < lu.rows(); ++i)
    if (lu.matrixLU()(i, i) < 0) sign = -sign;
  return sign;
}

VectorXd Curve::point(const VectorXd& y, double parameter) const {
  VectorXd u(y.size() + 1);
  u << y, parameter / scale_;
  return u;
}

void Curve::place(const VectorXd& u) {
  const double parameter = this->parameter(u);
  if (parameter != map_.parameter()) map_.set_parameter(parameter);
}

VectorXd Curve::residual(const VectorXd& u, PeriodicOrbit* passed) {
  place(u);
  return image(map_, state(u), multiple_, passed) - state(u);
}

CurveJacobian Curve::jacobian(const VectorXd& u, const MonodromyMatrix& nearby, MonodromyMatrix& slow,
                              PeriodicOrbit& passed, const VectorXd& also) {
  constexpr double kTolerance = 1e-6;  // of multipliers
  const int n = map_.size();
  place(u);
  VectorXd here;
  slow = slow_tangent(n, nearby, also, kTolerance, [&](const MatrixXd& directions) {
    MatrixXd moved = directions;
    // Of one period it is that applied last.
    if (here.size() == 0 || multiple_ > 1)
      here = image(map_, state(u), multiple_, &passed, &moved);
    else
      moved = map_.tangent_times(directions);
    return moved;
  });
  here -= state(u);
  const double step = slow.whole() ? kParameterStep : kParameterSideStep;
  VectorXd plus = u, minus = u;
  plus[n] *= 1 + step;
  minus[n] *= 1 - step;
  PeriodicOrbit of_plus, of_minus;
  VectorXd above = residual(plus, &of_plus), below = here;
  const bool of_above = same_sequence(passed.events, of_plus.events);
  // Of small states, whose tangent is exact, from both sides, and from one side where a contact comes or goes on the other.
  if (slow.whole() || !of_above) {
    below = residual(minus, &of_minus);
    const bool of_below = same_sequence(passed.events, of_minus.events);
    if (of_above && !of_below) {
      minus = u;
      below = here;
    } else if (of_below && !of_above) {
      plus = u;
      above = here;
    }
  } else {
    minus = u;
  }
  return {slow, (above - below) / (plus[n] - minus[n])};
}

std::optional<CurvePoint> Curve::correct(const VectorXd& predicted, const VectorXd& across,
                                         const CurvePoint* near) {
  constexpr int kMost = 16, kPatience = 3;
  constexpr double kSlow = 0.3;  // reduction of the residual, above which the Jacobian is computed anew
  CurvePoint p;
  p.u = predicted;
  if (near) {
    p.slow = near->slow;
    p.jacobian = near->jacobian;
  }
  const double tolerance = settings_.tolerance;
  double last = std::numeric_limits<double>::infinity();
  VectorXd before, step;
  left_range_ = false;
  try {
    for (;; ++p.corrections) {
      const VectorXd value = residual(p.u, &p.passed);
      const double least = last;
      p.residual = value.norm() / std::max(1.0, p.u.norm());
      if (!std::isfinite(p.residual) || !(parameter(p.u) > 0)) {
        failure_ = "the correction diverged";
        return std::nullopt;
      }
      if (p.residual <= tolerance || (p.residual <= 1e3 * tolerance && !(p.residual < 0.5 * last))) return p;
      if (p.corrections == kMost) {
        failure_ = text("no convergence in ", kMost, " corrections: residual ", p.residual);
        return std::nullopt;
      }
      if (p.corrections > kPatience && p.residual > 10 * last) {
        failure_ = text("the corrections diverge: residual ", p.residual);
        return std::nullopt;
      }
      last = std::min(last, p.residual);
      const bool slow = p.corrections >= kPatience && !(p.residual < kSlow * least);
      if (p.jacobian.empty() || p.slow.whole() || slow) {
        MonodromyMatrix found;
        p.jacobian = jacobian(p.u, p.slow, found, p.passed);
        p.slow = std::move(found);
      } else if (step.size() > 0) {
        p.jacobian.update(step, value - before);
      }
      before = value;
      step = p.jacobian.solve(across, -value, 0);
      p.u += step;
    }
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    failure_ = error.what();
    left_range_ = dynamic_cast<const ModelRangeError*>(&error) != nullptr;
    return std::nullopt;
  }
}

bool Curve::linearise(CurvePoint& p, const VectorXd& across) {
  try {
    MonodromyMatrix slow;
    VectorXd also;
    if (p.tangent.size() > 0) also = state(p.tangent);
    p.jacobian = jacobian(p.u, p.slow, slow, p.passed, also);
    p.slow = std::move(slow);
    p.tangent = p.jacobian.tangent(across);
    p.orientation = p.jacobian.sign(across);
    return true;
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    failure_ = error.what();
    return false;
  }
}

}  // namespace whine
