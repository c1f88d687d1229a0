// The branch of periodic orbits of a pair or a train over its sweeps.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/branch.h"
#include "results/response.h"

namespace whine {

// RMS of the dynamic transmission error of each mesh along the branch, stable and unstable, with the motions of the sweeps, and the
// largest modulus of the multipliers. sweeps: of the same pair or train, none, one or both directions. Throws Error(input) for a branch
// without orbits and sweeps of another number of meshes.
Figure branch_figure(const BranchResult& branch, const std::vector<ResponseResult>& sweeps);

}  // namespace whine
