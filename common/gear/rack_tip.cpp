#include "gear/rack_tip.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "gear/helix.h"
#include "gear/involute.h"

namespace whine {
namespace {

// rad: half of the root circle's arc between the two fillets of an internal gear, of this radius in modules; see
// ToothGeometry::round_root_of_ring.
double land_of_ring(const GearDesign& d, double radius) {
  const double pitch = 0.5 * d.teeth, base = pitch * std::cos(d.pressure_angle),
               root = pitch + d.dedendum - d.profile_shift, centre = root - radius,
               string = std::sqrt(std::max(0.0, centre * centre - base * base));
  const double thickness =
      0.5 * kPi + 2 * d.profile_shift * std::tan(d.pressure_angle) - d.tooth_thinning / d.module;
  const double half_base = thickness / (2 * pitch) - involute_function(d.pressure_angle);
  return kPi / d.teeth - half_base - (string + radius) / base + std::atan2(string, base);
}

}  // namespace

double largest_rack_tip_radius(const GearDesign& drawn) {
  const GearDesign d = transverse_section(drawn);
  const double in_drawing = d.module / drawn.module;
  if (d.internal) {
    constexpr double kMost = 1;  // the range of rack_tip_radius
    if (land_of_ring(d, 0) < 0) return -1;
    double low = 0, high = kMost;
    if (land_of_ring(d, high) >= 0) return high * in_drawing;
    for (int i = 0; i < 60; ++i) {  // the land shrinks as the fillets grow
      const double middle = 0.5 * (low + high);
      (land_of_ring(d, middle) < 0 ? high : low) = middle;
    }
    return low * in_drawing;
  }
  const double slope = std::tan(d.pressure_angle);
  return in_drawing * (0.25 * kPi + d.tooth_thinning / (2 * d.module) - d.dedendum * slope) /
         (1 / std::cos(d.pressure_angle) - slope);
}

double default_rack_tip_radius(const GearDesign& design, double standard) {
  const double largest = largest_rack_tip_radius(design);
  return largest >= standard ? standard : std::max(0.0, std::floor(largest * 1000) / 1000);
}

}  // namespace whine
