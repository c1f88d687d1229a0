// Order cuts: the first orders of the dynamic transmission error against speed.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"
#include "results/system_sweep.h"

namespace whine {

// Amplitudes of the first five orders of the mesh frequency, speed rising (a) and falling (b). Throws Error(input) unless it is
// given one sweep up and one down of the same gears and torque.
Figure order_figure(const std::vector<ResponseResult>& sweeps);

// The same of a system: a panel for each mesh, of planets that are alike for those of the first, speed rising and falling. Throws Error(input)
// unless the sweeps are of one system, one a direction at most.
Figure order_figure(const std::vector<SystemSweepResult>& sweeps);

}  // namespace whine
