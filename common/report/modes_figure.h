// Natural frequencies of a system by type, and drawings of its mode shapes.
#pragma once
#include "report/figures.h"
#include "results/modes.h"

namespace whine {

// The first kMostShapes shapes that are no free motions, one of each pair of equal frequencies, magnified. A body is drawn as its
// pitch circle with one radius, by which its rotation is seen; a carrier as the polygon of its pins with spokes.
inline constexpr size_t kMostShapes = 15;
Figure modes_figure(const ModesResult& modes);

}  // namespace whine
