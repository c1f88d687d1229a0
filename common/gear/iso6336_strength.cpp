#include "gear/iso6336_strength.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/face_width.h"

namespace whine {
namespace {

void require_external_spur_pair(const GearPair& pair) {
  if (pair.base_helix_angle() != 0)
    fail(
        Failure::input,
        "the formulas of ISO 6336-2 and -3, method B, are used here for spur gears only, and these are helical; take the computed line load and pressure alone");
  if (pair.internal())
    fail(Failure::input,
         "the formulas of ISO 6336-3, method B, are used here for external gears only, and gear ",
         pair.ring() == 0 ? "driver" : "driven", " is internal; take the computed root stress alone");
}

void require_two_pairs(const GearPair& pair, const char* what) {
  if (pair.contact_ratio() >= 2)
    fail(Failure::input, what, " is for a contact ratio below 2; here it is ", pair.contact_ratio(),
         "; take the computed value alone");
}

// m from the pitch point, along the driver's motion: where gear g carries the load of one pair farthest from its root. The driver
// carries it outwards, up to the point D, one base pitch after contact begins; the driven gear begins with it at B.
double outer_single_contact(const GearPair& pair, int g) {
  return g == 0 ? pair.path_start() + pair.base_pitch() : pair.path_end() - pair.base_pitch();
}

}  // namespace

IsoRoot iso_6336_root(const GearPair& pair, int g) {
  require_external_spur_pair(pair);
  require_two_pairs(pair, "the root stress of ISO 6336-3, method B,");
  const ToothGeometry& tooth = pair.gear(g);
  const GearDesign& d = tooth.design();
  const double z = d.teeth, m = d.module, alpha = d.pressure_angle;
  const double shift = d.profile_shift - d.tooth_thinning / (2 * m * std::tan(alpha));
  const double tip = d.rack_tip_radius;
  const double e = kPi / 4 - d.dedendum * std::tan(alpha) - (1 - std::sin(alpha)) * tip / std::cos(alpha);
  const double rolling = tip - d.dedendum + shift;  // G
  const double h = 2 / z * (kPi / 2 - e) - kPi / 3;
  double theta = kPi / 6;
  for (int i = 0; i < 100; ++i) {
    const double slope = 1 - 2 * rolling / z / (std::cos(theta) * std::cos(theta));
    const double step = (theta - 2 * rolling / z * std::tan(theta) + h) / slope;
    theta -= step;
    if (std::abs(step) < 1e-14) break;
  }
  if (!(theta > 0 && theta < kPi / 2))
    fail(Failure::numerical, "gear ", g == 0 ? "driver" : "driven",
         " has no section with a tangent of 30 degrees (theta = ", theta,
         " rad, between 0 and pi / 2); check dedendum and rack_tip_radius");
  const double fillet = rolling / std::cos(theta);
  const double s = z * std::sin(kPi / 3 - theta) + std::sqrt(3.0) * (fillet - tip);
  const double rho =
      tip + 2 * rolling * rolling / (std::cos(theta) * (z * std::cos(theta) * std::cos(theta) - 2 * rolling));
  const double roll = pair.nominal_roll(g, outer_single_contact(pair, g));                     // tan a_e
  const double at_load = std::atan(roll), diameter = z * std::cos(alpha) / std::cos(at_load);  // modules
  const double gamma =
      (kPi / 2 + 2 * shift * std::tan(alpha)) / z + involute_function(alpha) - involute_function(at_load);
  IsoRoot out;
  const double load_angle = at_load - gamma;  // a_Fe
  const double arm = 0.5 * ((std::cos(gamma) - std::sin(gamma) * std::tan(load_angle)) * diameter -
                            z * std::cos(kPi / 3 - theta) - fillet + tip);
  const double slenderness = s / arm, notch = s / (2 * rho);  // L, q_s
  out.thickness = s * m;
  out.form = 6 * arm * std::cos(load_angle) / (s * s * std::cos(alpha));
  out.stress_correction = (1.2 + 0.13 * slenderness) * std::pow(notch, 1 / (1.21 + 2.3 / slenderness));
  out.in_range = notch >= 1 && notch < 8;
  return out;
}

double iso_6336_root_stress(const GearPair& pair, int g, double tangential_force) {
  const IsoRoot root = iso_6336_root(pair, g);
  const GearDesign& d = pair.gear(g).design();
  const double width = carrying_width(d, contact_width(d, pair.gear(1 - g).design()));
  return tangential_force / (width * d.module) * root.form * root.stress_correction;
}

double iso_6336_flank_pressure(const GearPair& pair, const std::array<Material, 2>& material,
                               double tangential_force) {
  require_external_spur_pair(pair);
  require_two_pairs(pair, "the flank pressure of ISO 6336-2");
  const int pinion = pair.gear(0).design().teeth <= pair.gear(1).design().teeth ? 0 : 1;
  const GearDesign &d1 = pair.gear(pinion).design(), &d2 = pair.gear(1 - pinion).design();
  const double ratio = static_cast<double>(d2.teeth) / d1.teeth, width = contact_width(d1, d2);
  const double alpha = d1.pressure_angle, working = pair.working_pressure_angle();
  const double zone = std::sqrt(2 * std::cos(working) / std::sin(working)) / std::cos(alpha);
  double soft = 0;
  for (const Material& m : material) soft += (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  const double elastic = 1 / std::sqrt(kPi * soft);
  const double overlap = std::sqrt((4 - pair.contact_ratio()) / 3);
  return zone * elastic * overlap *
         std::sqrt(tangential_force / (d1.module * d1.teeth * width) * (ratio + 1) / ratio);
}

double loss_factor_of_rigid_teeth(const GearPair& pair) {
  require_two_pairs(pair, "the loss factor of rigid teeth");
  const double last = pair.path_end() / pair.base_pitch(), first = -pair.path_start() / pair.base_pitch();
  // sliding over the angle of the driver, per length along the path: (u + 1) / u of an external pinion that drives
  const double per_path = pair.sliding(pair.base_pitch()) / pair.base_pitch();
  return kPi * per_path / (pair.gear(0).design().teeth * std::cos(pair.base_helix_angle())) *
         (1 - pair.contact_ratio() + last * last + first * first);
}

}  // namespace whine
