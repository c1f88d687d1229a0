// The curve of periodic orbits F(u) = P^m(y) - y = 0 in u = (y, parameter / scale), its points, and Newton's method on to it.
//
// The Jacobian is kept as [-1, 0] + Y Z^T: the slow directions of the tangent (orbits/monodromy_matrix.h), the derivative by the
// parameter, and Broyden's updates by the periods that a correction integrates. Systems with it have as many unknowns as Y has
// columns. Where all directions are kept it is computed anew at each iterate, and this is Newton's method.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>

#include "orbits/monodromy_matrix.h"
#include "orbits/periodic_orbit.h"

namespace whine {

class CurveJacobian {
 public:
  CurveJacobian() = default;
  // slope: (size) dP^m / d(parameter / scale)
  CurveJacobian(const MonodromyMatrix& tangent, const Eigen::VectorXd& slope);
  bool empty() const { return left_.cols() == 0; }
  // Broyden: du changed F by change.
  void update(const Eigen::VectorXd& du, const Eigen::VectorXd& change);
  // [J; across^T] du = (right; last)
  Eigen::VectorXd solve(const Eigen::VectorXd& across, const Eigen::VectorXd& right, double last) const;
  // Of unit length, J t = 0, t . across > 0.
  Eigen::VectorXd tangent(const Eigen::VectorXd& across) const;
  // Sign of det [J; across^T], but for one that depends on the size of a state only.
  int sign(const Eigen::VectorXd& across) const;

 private:
  Eigen::MatrixXd small(const Eigen::VectorXd& across) const;
  Eigen::MatrixXd left_, right_;  // (size, .) Y, (size + 1, .) Z
};

struct CurvePoint {
  Eigen::VectorXd u, tangent;
  int orientation = 1;                                    // of det [dF; tangent^T]
  double bend = std::numeric_limits<double>::infinity();  // of the tangent's parameter component, per arc
  MonodromyMatrix slow;
  CurveJacobian jacobian;
  PeriodicOrbit passed;  // events and observable
  double residual = 0;
  int corrections = 0;
};

class Curve {
 public:
  Curve(PeriodMap& map, int multiple, double scale, const OrbitSettings& settings)
      : map_(map), multiple_(multiple), scale_(scale), settings_(settings) {}

  // Relative step of the parameter by which its derivative is taken: of short states central, of long ones, whose maps are
  // piecewise affine, one-sided. Nearer to a kink than some of these a tangent is of neither side.
  static constexpr double kParameterStep = 1e-6, kParameterSideStep = 1e-8;

  int size() const { return map_.size() + 1; }
  double parameter(const Eigen::VectorXd& u) const { return u[map_.size()] * scale_; }
  Eigen::VectorXd point(const Eigen::VectorXd& y, double parameter) const;
  Eigen::VectorXd state(const Eigen::VectorXd& u) const { return u.head(map_.size()); }

  // On the curve, in the plane across `across` through `predicted`; near: a point whose Jacobian serves first, if it has one.
  // Its events are there, nothing else: linearise() finds the rest. Nothing if there is none; failure() says why.
  std::optional<CurvePoint> correct(const Eigen::VectorXd& predicted, const Eigen::VectorXd& across,
                                    const CurvePoint* near);
  // Tangent, multipliers and orientation of a point that was corrected last. across: what its tangent shall not be
  // normal to, and points along. False if they cannot be found.
  bool linearise(CurvePoint& point, const Eigen::VectorXd& across);
  // The Jacobian at any point, and what happens in the periods from there.
  CurveJacobian jacobian(const Eigen::VectorXd& u, const MonodromyMatrix& nearby, MonodromyMatrix& slow,
                         PeriodicOrbit& passed, const Eigen::VectorXd& also = {});
  Eigen::VectorXd residual(const Eigen::VectorXd& u, PeriodicOrbit* passed = nullptr);
  const std::string& failure() const { return failure_; }
  bool left_range() const { return left_range_; }  // the model did not hold where the last correction went

 private:
  void place(const Eigen::VectorXd& u);
  PeriodMap& map_;
  int multiple_;
  double scale_;
  OrbitSettings settings_;
  std::string failure_;
  bool left_range_ = false;
};

bool same_sequence(const std::vector<ContactEvent>& a, const std::vector<ContactEvent>& b);

}  // namespace whine
