// A system of gears: all at their places with their teeth in mesh, names, senses of rotation, paths of contact.
#pragma once
#include "report/figures.h"
#include "results/modes.h"
#include "results/static.h"

namespace whine {

// Elastic gears have the teeth of their drawing, unloaded at mesh phase 0, and a close-up of the first mesh of each [[mesh]]. Rigid
// gears, of which teeth, base circles and meshes are known, have the working pitch circle of each mesh with a tick at each tooth.
// Lengths in mm. Throws Error(input) for a system without gears.
Figure system_picture(const SystemStaticResult& at_rest);
Figure system_picture(const StaticResult& pair);
Figure system_picture(const ModesResult& modes);

// A pair as it is drawn: the driver at the origin, the driven gear beside it, of a ring around it to its left. Without drives.
System layout_of_pair(const GearPairParameters& pair);

// "sun (27 teeth) 400.0 N m, ring (99 teeth) -1466.7 N m held": bodies on the ground, torques that are not 0. torque: (body) N m,
// mean; empty: not known.
std::string bodies_words(const System& system, const Eigen::VectorXd& torque);

}  // namespace whine
