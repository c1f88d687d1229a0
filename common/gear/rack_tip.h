// How round the tip of the rack may be, and with it the root that it cuts; of an internal gear the radius of its fillets.
#pragma once
#include "model/gear.h"

namespace whine {

// In modules, of a scene that gives none: ISO 53, profile A.
inline constexpr double kStandardRackTip = GearDesign{}.rack_tip_radius;

// In modules: with it the rack's tip, of an internal gear the space between two of its teeth, has no flat left; below 0: even a sharp
// one is too wide. External: (pi / 4 + thinning / 2 m - h_f tan alpha) / (1 / cos alpha - tan alpha); rack_tip_radius itself is not
// looked at.
double largest_rack_tip_radius(const GearDesign& design);

// In modules: the standard one, or the largest that fits, rounded down to 0.001.
double default_rack_tip_radius(const GearDesign& design, double standard = kStandardRackTip);

}  // namespace whine
