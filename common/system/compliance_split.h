// Where the compliance of a mesh at rest comes from: the bodies, the contact, the teeth.
//
// Displacements along the line of action under the whole load F, over F; they add up to 1 / mean mesh stiffness:
//   body     twist of the ring between bore and root circle, r_b^2 / (4 pi G b) (1 / r_bore^2 - 1 / r_root^2), of each gear: all
//            pairs in mesh share it; a rim on an elastic support twists by r_b^2 / (2 pi r_rim^3 k_t) more. The ring also moves
//            sideways against the hub, a fifth of what a bore changes; that counts with the teeth
//   contact  Hertz's approach at the pitch point, relative to half a tooth's thickness, of a pair that carries
//            F / contact ratio
//   teeth    the rest: bending, shear and foundation of the teeth of both gears, and gaps that a relief leaves in the mean
#pragma once
#include <vector>

#include "results/static.h"

namespace whine {

// Of a result that is complete but for this.
ComplianceSplit compliance_split(const StaticResult& statics);

// m N-1: twist of a gear's body along its line of action, as above; bore: m.
double body_twist(const GearDesign& gear, const Material& material, double bore);

// Of bodies that twist so much that the bore decides the stiffness.
std::vector<Remark> body_remarks(const StaticResult& statics);

}  // namespace whine
