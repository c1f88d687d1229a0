#include "gear/dynamic_factor.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace whine {

double iso_6336_dynamic_factor(const IsoDynamics& gears, double ratio) {
  const double eps = gears.contact_ratio;
  if (!(eps >= 1) || !(gears.line_load > 0) || !(gears.single_stiffness > 0) || !(ratio >= 0))
    fail(Failure::input, "no dynamic factor for a contact ratio of ", eps, " (at least 1), a line load of ",
         gears.line_load, " N/m and a stiffness of ", gears.single_stiffness,
         " N/m per m (both above 0) at a speed ratio of ", ratio, " (at least 0)");
  const bool high = eps > 2;
  const double v1 = 0.32, v2 = high ? 0.57 / (eps - 0.3) : 0.34, v3 = high ? 0.096 / (eps - 1.56) : 0.23,
               v4 = high ? (0.57 - 0.05 * eps) / (eps - 1.44) : 0.90, v5 = 0.47,
               v6 = high ? 0.12 / (eps - 1.74) : 0.47,
               v7 = eps <= 1.5   ? 0.75
                    : eps <= 2.5 ? 0.125 * std::sin(kPi * (eps - 2)) + 0.875
                                 : 1.0;
  const double per_load = gears.single_stiffness / gears.line_load;  // m-1
  const double pitch = per_load * gears.pitch_deviation, profile = per_load * gears.profile_deviation,
               relief = std::abs(1 - per_load * gears.relief);
  const double share = gears.line_load / 100e3;
  const double resonance = share < 1 ? 0.5 + 0.35 * std::sqrt(share) : 0.85;  // N_S
  const double at_resonance = 1 + v1 * pitch + v2 * profile + v4 * relief;
  const double beyond = v5 * pitch + v6 * profile + v7;
  if (ratio <= resonance) return 1 + ratio * (v1 * pitch + v2 * profile + v3 * relief);
  if (ratio <= 1.15) return at_resonance;
  if (ratio >= 1.5) return beyond;
  return beyond + (at_resonance - beyond) * (1.5 - ratio) / 0.35;
}

}  // namespace whine
