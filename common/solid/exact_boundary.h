// Nodes of the half sector on its exact curves: gmsh's splines lie micrometres off.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "solid/gmsh_mesh.h"

namespace whine {

// Puts points on exact curves of the half sector.
class ExactBoundary {
 public:
  explicit ExactBoundary(const ToothGeometry& tooth);
  // Of the point of the flank nearest to p by its radius.
  double roll_angle(const Vec2& p) const;
  Vec2 put(Curve kind, const Vec2& p) const;
  // Between two nodes of a boundary edge.
  Vec2 middle(Curve kind, const Vec2& a, const Vec2& b) const;

 private:
  const ToothGeometry& tooth_;
  Vec2 edge_;
};

// rad: of the point of a side of the flank that has its ends at these roll angles, a: -1 to 1 along the side. It goes with the arc length,
// r_b xi^2 / 2, as the middle node does: near the base circle the middle of the angle lies at a quarter of the side.
double roll_angle_between(double from, double to, double a);

// Moves boundary nodes onto their curves; a corner of the sector goes onto both of its curves by taking the
// point of the geometry itself.
void make_exact(HalfGrid& half, const ToothGeometry& tooth, const ExactBoundary& exact);

// Adds mid-side and centre nodes. (element, 9)
std::vector<std::array<int, 9>> raise_order(HalfGrid& half, const ExactBoundary& exact);

// The parameter in [from, to] of the point of `curve` nearest to p.
double nearest_parameter(const std::function<Vec2(double)>& curve, const Vec2& p, double from, double to);

}  // namespace whine
