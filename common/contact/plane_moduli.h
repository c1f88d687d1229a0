// Hooke's law of a plane body, in plane strain or plane stress.
#pragma once
#include <Eigen/Core>

#include "model/gear.h"

namespace whine {

// Plane strain moduli that give the material's plane state: in plane stress E (1 + 2 nu) / (1 + nu)^2 and nu
// / (1 + nu).
struct PlaneModuli {
  double youngs_modulus = 0;  // Pa
  double poisson_ratio = 0;   // 1
};
PlaneModuli plane_strain_equivalent(const Material& material);

// Stress (xx, yy, xy) from strain (xx, yy, engineering xy). (3, 3) Pa
Eigen::Matrix3d plane_elasticity(const Material& material);

}  // namespace whine
