// The rectangular wave that approximates a mesh stiffness: levels from the curve in the middle of the two zones; it switches where
// pairs enter and leave contact without load.
#pragma once
#include "results/static.h"

namespace whine {

RectangularWave rectangular_wave(const StaticResult& pair);

}  // namespace whine
