// A normal line load on an elastic half-plane (Flamant): Johnson, Contact Mechanics (1985), section 2.2.
//
// x along the surface, z into the body, P per unit length of the line, for plane strain moduli E, nu:
//   u_z = P (1 + nu) / (pi E) [-2 (1 - nu) ln r + z^2 / r^2] + constant
//   u_x = P (1 + nu) / (pi E) [x z / r^2 - (1 - 2 nu) atan2(x, z)]
//   stress: only sigma_r = -2 P cos(theta) / (pi r), theta measured from +z.
// The constant makes u_z vanish at the reference depth under the load. The field is continued beyond the
// surface: it stays an elastic field without body force everywhere but on the outward axis of the load.
#pragma once
#include "contact/plane_moduli.h"
#include "gear/involute.h"

namespace whine {

// Inward displacement of the surface at distance x of a unit total force on a flat half-plane, relative to
// the depth under the load: C (ln(depth / |x|) - 1 / (2 (1 - nu))), C = 2 (1 - nu^2) / (pi E thickness). m
// N-1; x != 0.
double flat_surface_displacement(double x, const PlaneModuli& moduli, double thickness, double depth);

class LineLoadField {
 public:
  // A unit force, spread over the thickness, that presses at `point` against the outward normal `normal`.
  LineLoadField(const Vec2& point, const Vec2& normal, const PlaneModuli& moduli, double thickness,
                double depth);

  Vec2 displacement(const Vec2& p) const;  // m N-1; p is not the loaded point
  Vec2 traction(const Vec2& p,
                const Vec2& outward) const;  // per metre of boundary and per newton, thickness included: m-1

 private:
  Vec2 local(const Vec2& p) const { return {tangent_.dot(p - point_), inward_.dot(p - point_)}; }  // x, z
  Vec2 point_, inward_, tangent_;
  double nu_, scale_, constant_;
};

// The same of a unit force that is spread evenly over `width` (m) of the surface about `point`; Johnson, section 2.5. Finite
// everywhere. Displacements are those of the line load, averaged over the strip, with the same constant.
class StripLoadField {
 public:
  StripLoadField(const Vec2& point, const Vec2& normal, double width, const PlaneModuli& moduli,
                 double thickness, double depth);

  const Vec2& point() const { return point_; }  // m
  Vec2 displacement(const Vec2& p) const;       // m N-1
  Eigen::Vector3d stress(const Vec2& p) const;  // m-2: xx, yy, xy, in the frame of p

 private:
  Vec2 point_, inward_, tangent_;
  double half_width_, thickness_, nu_, scale_, constant_;
};

}  // namespace whine
