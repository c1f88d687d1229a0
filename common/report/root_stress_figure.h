// What a tooth suffers: root stress over the mesh cycle and over speed, dynamic factors, losses.
#pragma once
#include "report/figures.h"
#include "results/branch.h"
#include "results/response.h"

namespace whine {

// Root stress of both gears while a tooth passes through the mesh (a) and its largest value over speed, both sweep directions (b);
// dynamic factors of mesh force, tooth load and root stress beside K_v of ISO 6336-1, method B (c): over T / r_b or over the
// largest at rest. In motion all are what is sustained for 1/64 of a mesh period, and root stress is quasi-static in the tooth loads.
// External pairs also show sigma_F0 of ISO 6336-3, method B. What a formula of the standard cannot say is left out, and a note says
// why, as it does outside of the range in which the formula was tested. Tables: what is drawn, and loss factors. Throws
// Error(input) for artifacts without root stress, sustained loads or losses, of another torque, or that are not two sweeps, up and down.
Figure root_stress_figure(const StaticResult& statics, const std::vector<ResponseResult>& sweeps,
                          const std::vector<BranchResult>& branches = {});

}  // namespace whine
