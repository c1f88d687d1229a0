// The Harris map of tip relief.
#pragma once
#include "report/figures.h"
#include "results/harris_map.h"

namespace whine {

// Peak-to-peak transmission error against torque and tip relief, with the best relief of each torque and the optimum for the
// design torque; beside it, against torque, that relief of each start and no relief (the Harris cusp). The map is that of
// the start whose optimum is least. With a dynamic part its map of the RMS at the worst speed stands below.
Figure harris_map_figure(const HarrisMapResult& map);

}  // namespace whine
