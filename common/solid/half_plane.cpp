#include "solid/half_plane.h"

#include <cmath>
#include <numbers>

namespace whine {

namespace {
constexpr double kPi = std::numbers::pi;
}

double flat_surface_displacement(double x, const PlaneModuli& moduli, double thickness, double depth) {
  const double nu = moduli.poisson_ratio;
  const double c = 2 * (1 - nu * nu) / (kPi * moduli.youngs_modulus * thickness);
  return c * (std::log(depth / std::abs(x)) - 0.5 / (1 - nu));
}

LineLoadField::LineLoadField(const Vec2& point, const Vec2& normal, const PlaneModuli& moduli,
                             double thickness, double depth)
    : point_(point), inward_(-normal), tangent_(-normal.y(), normal.x()), nu_(moduli.poisson_ratio) {
  scale_ = (1 + nu_) / (kPi * moduli.youngs_modulus * thickness);
  constant_ = scale_ * (2 * (1 - nu_) * std::log(depth) - 1);  // at (0, depth): z^2 / r^2 = 1
}

Vec2 LineLoadField::displacement(const Vec2& p) const {
  const Vec2 q = local(p);
  const double x = q.x(), z = q.y(), r2 = q.squaredNorm();
  const double along = scale_ * (x * z / r2 - (1 - 2 * nu_) * std::atan2(x, z));
  const double into = scale_ * (-(1 - nu_) * std::log(r2) + z * z / r2) + constant_;
  return along * tangent_ + into * inward_;
}

Vec2 LineLoadField::traction(const Vec2& p, const Vec2& outward) const {
  const Vec2 ray = p - point_;
  const double r2 = ray.squaredNorm();
  // sigma_r (ray . outward) ray / r^2, sigma_r = -2 z / (pi r^2)
  return (-2 * inward_.dot(ray) / (kPi * r2) * ray.dot(outward) / r2) * ray;
}

}  // namespace whine
