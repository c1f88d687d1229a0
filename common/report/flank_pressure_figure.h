// Pressure over the flanks and over speed, and what tip edges carry.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"

namespace whine {

// statics: at the torque of the sweeps. sweeps: up and down, with flank pressure (studies/sweep_pressure.h). The map of falling
// speed is drawn where it differs from that of rising speed by more than 1 % of the largest pressure. Throws Error(input) for
// sweeps of other torques or directions and for those without flank pressure.
Figure flank_pressure_figure(const StaticResult& statics, const std::vector<ResponseResult>& sweeps);

}  // namespace whine
