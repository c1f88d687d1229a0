// What can go wrong between an internal gear and the pinion in it, beside the line of action.
//
// Angles from the line of centres, about either axis; 1 the pinion, 2 the ring; alpha_a the pressure angle at a tip:
//   pinion tip at eta:  ring tip at (eta + inv alpha_a1 - inv alpha_w) z1 / z2 + inv alpha_w - inv alpha_a2,
// of the two flanks that touch. Both checks ask whether the ring's edge then lies farther out. Backlash is not counted.
#pragma once
#include "gear/pair.h"

namespace whine {

// m, along the ring's tip circle: distance of the tip edges of a pinion and a ring tooth where their paths cross beside the mesh;
// below 0: trochoid interference. Infinite for external pairs and where the tip circles do not cross.
double tip_clearance(const GearPair& pair);

// m, across the line of centres: least distance of these edges as the pinion is moved along it, out of the ring; below 0: it
// cannot be put in by a radial movement (trimming interference) and has to come in along its axis. Infinite for external
// pairs.
double radial_assembly_clearance(const GearPair& pair);

}  // namespace whine
