#include "gear/iso6336.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gear/face_width.h"
#include "gear/helix.h"

namespace whine {

IsoStiffness iso_6336_stiffness(const GearDesign& a, const Material& of_a, const GearDesign& b,
                                const Material& of_b, double torque, double contact_ratio) {
  // The pinion is gear 1.
  const GearDesign &pinion = a.teeth <= b.teeth ? a : b, &wheel = a.teeth <= b.teeth ? b : a;
  // Of an internal gear the standard takes a rack in its place.
  const auto virtual_teeth = [](const GearDesign& g) {  // z_n
    const double cosine = std::cos(base_helix_angle(g));
    return g.teeth / (cosine * cosine * std::cos(g.helix_angle));
  };
  const double z1 = virtual_teeth(pinion),
               z2 = wheel.internal ? std::numeric_limits<double>::infinity() : virtual_teeth(wheel),
               x1 = pinion.profile_shift, x2 = wheel.profile_shift;
  const double q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1 - 0.00193 * x2 -
                   0.24188 * x2 / z2 + 0.00529 * x1 * x1 + 0.00182 * x2 * x2;
  constexpr double kMeasured = 0.8;                    // C_M
  constexpr double kPerMillimetreMicrometre = 1e9;     // N/(mm um) in N m-1 per m
  constexpr double kFullLoad = 100e3, kSteel = 206e9;  // N m-1, Pa
  const auto rack = [](const GearDesign& g) {
    return (1 + 0.5 * (1.2 - g.dedendum)) * (1 - 0.02 * (20 - g.pressure_angle * 180 / std::numbers::pi));
  };
  const double modulus =
      2 * of_a.youngs_modulus * of_b.youngs_modulus / (of_a.youngs_modulus + of_b.youngs_modulus);
  IsoStiffness out;
  out.line_load = torque / (0.5 * a.teeth * transverse_section(a).module) / contact_width(a, b);
  const double load = std::min(1.0, std::pow(out.line_load / kFullLoad, 0.25));
  out.single = kMeasured * 0.5 * (rack(a) + rack(b)) / q * (modulus / kSteel) * load *
               kPerMillimetreMicrometre * std::cos(a.helix_angle);
  out.mesh = out.single * (0.75 * contact_ratio + 0.25);
  out.in_range =
      x1 + x2 >= -0.5 && x1 + x2 <= 2 && contact_ratio >= 1.2 && contact_ratio <= 1.9 && !wheel.internal;
  return out;
}

}  // namespace whine
