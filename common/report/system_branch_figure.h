// The branch of periodic orbits of a system over its sweeps.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"
#include "results/system_branch.h"

namespace whine {

// RMS of the dynamic transmission error of each mesh along the branch, stable and unstable, with the motions of the sweeps, and the
// largest modulus of the multipliers. sweeps: of the same system, none, one or both directions. Throws Error(input) for a branch
// without orbits and sweeps of another number of meshes.
Figure system_branch_figure(const SystemBranchResult& branch, const std::vector<ResponseResult>& sweeps);

}  // namespace whine
