#include "gear/helix.h"

#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"

namespace whine {

GearDesign transverse_section(const GearDesign& design) {
  GearDesign section = design;
  if (!design.helical()) return section;
  const double cosine = std::cos(design.helix_angle);
  section.helix_angle = 0;
  section.module = design.module / cosine;
  section.pressure_angle = std::atan(std::tan(design.pressure_angle) / cosine);
  for (double* in_modules :
       {&section.profile_shift, &section.addendum, &section.dedendum, &section.rack_tip_radius})
    *in_modules *= cosine;
  return section;
}

double base_helix_angle(const GearDesign& design) {
  if (!design.helical()) return 0;
  const double angle = std::asin(std::sin(design.helix_angle) * std::cos(design.pressure_angle));
  return design.hand == Hand::right ? angle : -angle;
}

std::string helix_fault(const GearDesign& driver, const GearDesign& driven) {
  const auto degrees = [](const GearDesign& d) { return shown_number(d.helix_angle / kOneDegree); };
  if (std::abs(driver.helix_angle - driven.helix_angle) > 1e-12)
    return text("helix angles differ: driver ", degrees(driver), " deg, driven gear ", degrees(driven),
                " deg; on parallel axes they are equal: give both gears the same helix_angle_deg");
  if (!driver.helical()) return "";
  const bool internal = driver.internal || driven.internal, alike = driver.hand == driven.hand;
  if (alike == internal) return "";
  return text("both gears have ", alike ? "" : "not ", "the same hand, \"", driver.hand,
              alike ? "\"" : text("\" and \"", driven.hand, "\""), "; ",
              internal ? "an internal gear has the hand of its pinion" : "gears in mesh have opposite hands",
              ": write hand = \"", (driver.hand == Hand::right) == internal ? Hand::right : Hand::left,
              "\" for the driven gear");
}

double helix_twist(const GearDesign& design) {
  if (!design.helical()) return 0;
  const GearDesign section = transverse_section(design);
  return std::tan(base_helix_angle(design)) /
         (0.5 * section.teeth * section.module * std::cos(section.pressure_angle));
}

}  // namespace whine
