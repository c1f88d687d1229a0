#include "gear/hertz.h"

#include <cmath>
#include <numbers>

#include "gear/pair.h"

namespace whine {

HertzContact hertz_contact(const GearPairParameters& pair, double force) {
  double compliance = 0;  // Pa-1: 1 / E*
  for (const BodyParameters& gear : pair.gear) {
    const Material m = in_contact_plane(gear.material, pair.mesh.contact_plane);
    compliance += (m.plane_stress ? 1 : 1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  }
  const double per_width = force / pair.face_width(), radius = GearPair(pair).relative_curvature_radius(0.0);
  return {std::sqrt(4 * per_width * radius * compliance / std::numbers::pi),
          std::sqrt(per_width / (std::numbers::pi * radius * compliance))};
}

}  // namespace whine
