// A system of elastic gears over its speeds: vibration and contact loss of each mesh, forces on bearings.
#pragma once
#include <vector>

#include "report/figures.h"
#include "studies/system_sweep_result.h"

namespace whine {

// sweeps: of one system, one or both directions. RMS of the dynamic transmission error, share of the time without contact and
// largest force of each mesh, oscillating force of each bearing, over mesh frequency.
Figure system_sweep_figure(const std::vector<SystemSweepArtifact>& sweeps);

}  // namespace whine
