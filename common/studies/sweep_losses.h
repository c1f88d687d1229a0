// Losses of a sweep by the loads that its teeth carry.
#pragma once
#include "results/sweep.h"

namespace whine {

// (speed) 1: H_V of gear/losses.h over the mesh periods that are stored. Empty for a sweep without root stress,
// such as that of a lumped model: an artifact has both or neither.
Eigen::VectorXd loss_factors(const SweepResult& sweep);

}  // namespace whine
