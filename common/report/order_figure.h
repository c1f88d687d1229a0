// Order cuts: the first orders of the dynamic transmission error against speed.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"

namespace whine {

// Amplitudes of the first five orders of the mesh frequency, speed rising (a) and falling (b). Throws Error(input) unless it is
// given one sweep up and one down of the same gears and torque.
Figure order_figure(const std::vector<ResponseResult>& sweeps);

}  // namespace whine
