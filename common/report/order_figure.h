// Order cuts: the first orders of the dynamic transmission error against speed.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"

namespace whine {

// Amplitudes of the first five orders of the mesh frequency. Of a pair speed rising (a) and falling (b); Error(input) unless it is
// given one sweep up and one down of the same gears and torque. Of a train a panel for each mesh, of planets that are alike for those
// of the first; Error(input) unless the sweeps are of one train, one a direction at most.
Figure order_figure(const std::vector<ResponseResult>& sweeps);

}  // namespace whine
