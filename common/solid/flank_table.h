// Points of the flank tables on the flank, and their interpolation.
//
// Table points are Chebyshev points of the first kind in zeta = ln(1 + delta / delta0), delta = arc length
// along the flank from the tip edge, delta0 = module / 60. Near the corner the elastic field of a wedge
// depends on ratios of distances, so the logarithm spends the points where they are needed. The interpolation
// is the barycentric formula of the second kind (Berrut and Trefethen, SIAM Review 46 (2004) 501): stable,
// exact at the points. One row of weights S serves load and reading alike: R(s, s') = S(s) R S(s')^T stays
// symmetric and semidefinite.
#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "gear/involute.h"

namespace whine {

class FlankTable {
 public:
  // The table of a tooth's driving flank, from the form point to the tip edge; points: number of points, 2 or
  // more.
  FlankTable(const ToothGeometry& tooth, int points);
  // base_radius, tip_scale (delta0): m; roll angles: rad, different and not below 0; that of the tip is the larger one, of an
  // internal gear the smaller. Throws Error(input) otherwise.
  FlankTable(double base_radius, double form_roll_angle, double tip_roll_angle, double tip_scale, int points);

  int size() const { return static_cast<int>(points_.size()); }
  const Eigen::VectorXd& points() const { return points_; }  // (point) rad: roll angles, ascending
  double lowest() const { return std::min(form_, tip_); }    // rad
  double highest() const { return std::max(form_, tip_); }   // rad

  // (point) 1: value(xi) = weights(xi) . values at the points. Between the outermost point and the end of the
  // flank the polynomial goes on; more than 1e-9 rad beyond the flank throws Error(numerical) with the numbers.
  Eigen::RowVectorXd weights(double xi) const;

 private:
  double zeta(double xi) const;  // 1
  double base_radius_, form_, tip_, tip_scale_;
  Eigen::VectorXd points_, zeta_, barycentric_;
};

}  // namespace whine
