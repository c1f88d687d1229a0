#include "contact/plane_moduli.h"

namespace whine {

PlaneModuli plane_strain_equivalent(const Material& material) {
  const double e = material.youngs_modulus, nu = material.poisson_ratio;
  if (!material.plane_stress) return {e, nu};
  return {e * (1 + 2 * nu) / ((1 + nu) * (1 + nu)), nu / (1 + nu)};
}

Eigen::Matrix3d plane_elasticity(const Material& material) {
  const auto [e, nu] = plane_strain_equivalent(material);
  const double scale = e / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix3d d;
  d << 1 - nu, nu, 0, nu, 1 - nu, 0, 0, 0, 0.5 - nu;
  return scale * d;
}

}  // namespace whine
