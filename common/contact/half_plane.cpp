#include "contact/half_plane.h"

#include <cmath>

#include "base/units.h"

namespace whine {

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

StripLoadField::StripLoadField(const Vec2& point, const Vec2& normal, double width, const PlaneModuli& moduli,
                               double thickness, double depth)
    : point_(point),
      inward_(-normal),
      tangent_(-normal.y(), normal.x()),
      half_width_(0.5 * width),
      thickness_(thickness),
      nu_(moduli.poisson_ratio) {
  scale_ = (1 + nu_) / (kPi * moduli.youngs_modulus * thickness);
  constant_ = scale_ * (2 * (1 - nu_) * std::log(depth) - 1);
}

namespace {

// Antiderivatives in x, at a fixed z, of what a line load's field is made of.
struct Antiderivative {
  Antiderivative(double x, double z) {
    const double r2 = x * x + z * z, angle = std::atan2(x, z);
    const double z_ln_r = r2 > 0 ? 0.5 * z * std::log(r2) : 0;
    ln_r = (r2 > 0 ? 0.5 * x * std::log(r2) : 0) - x + z * angle;
    zz_over_r2 = z * angle;
    xz_over_r2 = z_ln_r;
    atan = x * angle - z_ln_r;
    const double cross = r2 > 0 ? x * z / r2 : 0;
    zzz_over_r4 = 0.5 * (angle + cross);
    xxz_over_r4 = 0.5 * (angle - cross);
    xzz_over_r4 = r2 > 0 ? -0.5 * z * z / r2 : 0;
  }
  double ln_r, zz_over_r2, xz_over_r2, atan, zzz_over_r4, xxz_over_r4, xzz_over_r4;
};

}  // namespace

Vec2 StripLoadField::displacement(const Vec2& p) const {
  const double x = tangent_.dot(p - point_), z = inward_.dot(p - point_);
  const Antiderivative to(x + half_width_, z), from(x - half_width_, z);
  const double scale = scale_ / (2 * half_width_);
  const double along = scale * (to.xz_over_r2 - from.xz_over_r2 - (1 - 2 * nu_) * (to.atan - from.atan));
  const double into =
      scale * (-2 * (1 - nu_) * (to.ln_r - from.ln_r) + to.zz_over_r2 - from.zz_over_r2) + constant_;
  return along * tangent_ + into * inward_;
}

Eigen::Vector3d StripLoadField::stress(const Vec2& p) const {
  const double x = tangent_.dot(p - point_), z = inward_.dot(p - point_);
  const Antiderivative to(x + half_width_, z), from(x - half_width_, z);
  const double scale = -1 / (kPi * half_width_ * thickness_);
  const double xx = scale * (to.xxz_over_r4 - from.xxz_over_r4),
               zz = scale * (to.zzz_over_r4 - from.zzz_over_r4),
               xz = scale * (to.xzz_over_r4 - from.xzz_over_r4);
  const Eigen::Matrix2d turned = xx * tangent_ * tangent_.transpose() + zz * inward_ * inward_.transpose() +
                                 xz * (tangent_ * inward_.transpose() + inward_ * tangent_.transpose());
  return {turned(0, 0), turned(1, 1), turned(0, 1)};
}

}  // namespace whine
