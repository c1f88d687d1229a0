#include "gear/drawing_quantities.h"

#include <cmath>

#include "base/units.h"
#include "gear/helix.h"
#include "gear/tooth_errors.h"

namespace whine {

double reference_thickness(const ToothGeometry& gear) {
  return gear.thickness_at_radius(gear.pitch_radius());
}

std::optional<Span> span_measurement(const ToothGeometry& gear) {
  if (gear.internal()) return std::nullopt;
  // Along the normal of a helix; the points touched stand as far from each other along the face.
  const double cosine = std::cos(base_helix_angle(gear.design()));
  const double base = gear.base_radius(), on_base = gear.thickness_at_radius(base),
               middle = gear.pitch_radius() + gear.design().profile_shift * gear.design().module,
               form = base * std::hypot(1.0, gear.form_roll_angle());
  std::optional<Span> best;
  for (int k = 2; k < gear.design().teeth; ++k) {
    const double length = cosine * ((k - 1) * gear.base_pitch() + on_base),
                 radius = std::hypot(base, 0.5 * length * cosine);
    if (radius > gear.tip_radius()) break;
    if (radius < form) continue;
    if (!best || std::abs(radius - middle) < std::abs(0.5 * best->diameter - middle))
      best = Span{k, length, 2 * radius};
  }
  return best;
}

double tip_clearance_to_root(const GearPair& pair, int g) {
  const double tip = pair.gear(g).tip_radius(), root = pair.gear(1 - g).root_radius(),
               centres = pair.centre_distance();
  if (!pair.internal()) return centres - tip - root;
  return pair.ring() == g ? tip - centres - root : root - centres - tip;
}

double normal_force(const GearDesign& driver, double torque) {
  return torque / (ToothGeometry(driver).base_radius() * std::cos(base_helix_angle(driver)));
}

double normal_backlash(const GearPair& pair) {
  return pair.backlash() * std::cos(pair.base_helix_angle());
}

double circumferential_backlash(const GearPair& pair) {
  return pair.backlash() / std::cos(pair.working_pressure_angle());
}

std::array<std::optional<double>, 2> specific_sliding(const GearPair& pair, double path) {
  std::array<double, 2> rolling{};  // m per turn of the mesh, over 2 pi
  for (int g = 0; g < kSides; ++g)
    rolling[static_cast<size_t>(g)] =
        pair.gear(g).base_radius() * pair.nominal_roll(g, path) / pair.gear(g).design().teeth;
  std::array<std::optional<double>, 2> out;
  constexpr double kAtBase = 1e-9;  // of the mate's
  for (size_t g = 0; g < kSides; ++g)
    if (rolling[g] > kAtBase * std::abs(rolling[1 - g])) out[g] = 1 - rolling[1 - g] / rolling[g];
  return out;
}

double most_error_of_class(const GearPair& pair, int iso_class) {
  const double steps = std::ceil(pair.contact_ratio()) - 1;
  double most = 0;
  for (int g = 0; g < kSides; ++g) {
    const FlankTolerances limits = iso_1328_tolerances(pair.gear(g).design(), iso_class);
    most +=
        steps * limits.single_pitch * std::cos(pair.gear(g).design().pressure_angle) + limits.profile_total;
  }
  return most;
}

}  // namespace whine
