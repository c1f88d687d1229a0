// Where the compliance of a mesh at rest comes from: the bodies, the contact, the teeth; and what ISO 6336 says beside it.
//
// Displacements along the line of action under the whole load F, over F; they add up to 1 / mean mesh stiffness:
//   body     twist of the ring between bore and root circle, r_b^2 / (4 pi G b) (1 / r_bore^2 - 1 / r_root^2), of each gear: all
//            pairs in mesh share it; a rim on an elastic support twists by r_b^2 / (2 pi r_rim^3 k_t) more. The ring also moves
//            sideways against the hub, a fifth of what a bore changes; that counts with the teeth
//   contact  Hertz's approach at the pitch point, relative to half a tooth's thickness, of a pair that carries
//            F / contact ratio
//   teeth    the rest: bending, shear and foundation of the teeth of both gears, and gaps that a relief leaves in the mean
#pragma once
#include <array>

#include "gear/iso6336.h"
#include "results/static.h"
#include "system/statics.h"

namespace whine {

struct ComplianceSplit {
  double whole = 0, contact = 0, teeth = 0;  // m N-1
  std::array<double, 2> body{};              // m N-1, of driver and driven gear
  // 1: relative change of the mean mesh stiffness if the bore of one gear were a tenth larger, by the twist alone
  std::array<double, 2> wider_bore{};
  double single = 0;  // N m-1: largest stiffness of a pair that carries all the load; 0: no pair ever does
  // N m-1: `single` and the mean mesh stiffness if the bodies did not twist, as in ISO 6336
  double single_teeth = 0, mean_teeth = 0;
  IsoStiffness iso;

  double body_share() const { return (body[0] + body[1]) / whole; }
};
ComplianceSplit compliance_split(const StaticResult& statics);

// m N-1: twist of a gear's body along its line of action, as above; bore: m.
double body_twist(const GearDesign& gear, const Material& material, double bore);

// Of bodies that twist so much that the bore decides the stiffness.
std::vector<Remark> body_remarks(const StaticResult& statics);

}  // namespace whine
