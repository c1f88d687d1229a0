// A system of elastic gears over its speeds: vibration and contact loss of each mesh, forces on bearings.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"

namespace whine {

// sweeps: of one system, one or both directions. RMS of the dynamic transmission error, share of the time without contact and
// largest force of each mesh, oscillating force of each bearing, over mesh frequency.
Figure system_sweep_figure(const std::vector<ResponseResult>& sweeps);

}  // namespace whine
