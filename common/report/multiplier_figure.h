// Multipliers of a branch of periodic orbits in the complex plane, and their largest modulus against the mesh frequency.
#pragma once
#include "report/figures.h"
#include "results/branch.h"

namespace whine {

// Of each orbit the multipliers of a modulus above 0.05. Notes name folds with the multipliers on either side.
Figure multiplier_figure(const BranchResult& branch);

}  // namespace whine
