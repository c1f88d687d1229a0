// What a Harris map covers where its user does not say: torques, reliefs, where they start.
#pragma once
#include <string>
#include <vector>

#include "studies/harris_map.h"

namespace whine {

// N m: 60 torques up to twice the design torque.
std::vector<double> default_torques(double design_torque);

// m: 40 reliefs up to 1.2 times what the teeth bend under `torque` (N m) without tip relief, rounded up to a micrometre.
std::vector<double> default_reliefs(const ReducedBody& driver, const ReducedBody& driven,
                                    StaticParameters settings, double torque);

// m, of roll to the tip edge, of starts given as roll angles of the driver in degrees, largest first; or as they are given in
// mm; of neither, that of the scene's own relief of the driver, or from the highest point of single-pair contact. Throws
// Error(usage), in degrees, for a start that does not fit a flank that is relieved.
std::vector<double> relief_lengths(const std::vector<double>& starts, const std::vector<double>& millimetres,
                                   const ReducedBody& first, const ReducedBody& second,
                                   const GearMeshSpec& mesh, Relieved relieved);

}  // namespace whine
