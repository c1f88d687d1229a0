#include "gear/handbook_sign.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/format.h"
#include "gear/pair.h"

namespace whine {
namespace {

// Modules: backlash on the line of action beyond what thinned teeth leave; not a number for gears that do not mesh.
double excess_backlash(const GearDesign& driver, const GearDesign& driven, double centre_distance) {
  try {
    const GearPair pair(driver, driven, centre_distance);
    return (pair.backlash() -
            (driver.tooth_thinning + driven.tooth_thinning) * std::cos(driver.pressure_angle)) /
           driver.module;
  } catch (const Error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

// Heights that gears have, in modules.
bool usual(const GearDesign& d) {
  return d.addendum >= 0.6 && d.addendum <= 1.2 && d.dedendum >= 1 && d.dedendum <= 1.6;
}

// The same diameters with the shift of the other sign.
GearDesign with_other_sign(GearDesign design) {
  design.addendum += 2 * design.profile_shift;
  design.dedendum -= 2 * design.profile_shift;
  design.profile_shift = -design.profile_shift;
  return design;
}

}  // namespace

std::optional<double> shift_of_other_sign(const GearDesign& driver, const GearDesign& driven,
                                          double centre_distance) {
  const GearDesign& ring = driver.internal ? driver : driven;
  if (!ring.internal || ring.profile_shift == 0 || driver.internal == driven.internal) return {};
  constexpr double kFits = 0.02, kMore = 0.04;  // modules
  const double now = excess_backlash(driver, driven, centre_distance);
  GearDesign same_heights = ring;
  same_heights.profile_shift = -ring.profile_shift;
  const GearDesign same_diameters = with_other_sign(ring);
  const bool of_diameters = !usual(ring) && usual(same_diameters);
  for (const GearDesign& other : {same_heights, same_diameters}) {
    const double then = driver.internal ? excess_backlash(other, driven, centre_distance)
                                        : excess_backlash(driver, other, centre_distance);
    if (std::abs(now) <= kMore + 4 * std::abs(then)) continue;
    if (std::abs(then) <= kFits || (of_diameters && then > 0)) return -ring.profile_shift;
  }
  return {};
}

std::string other_sign_words(double shift) {
  return text(
      "profile_shift = ", shown_number(shift),
      " fits: handbooks that count the shift of an internal gear outwards give it the other sign; here it is positive inwards, towards the tips (ISO 21771)");
}

}  // namespace whine
