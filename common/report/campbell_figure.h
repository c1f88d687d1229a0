// Campbell diagram of a system: natural frequencies and the harmonics of the mesh frequency that excite them.
#pragma once
#include "report/figures.h"
#include "results/modes.h"

namespace whine {

// Crossings f_mesh = f_n / l of the harmonics l = 1 .. kCampbellHarmonics are in a table of their own; of elastic gears a band
// spans the frequencies of all mesh phases.
inline constexpr int kCampbellHarmonics = 5;
Figure campbell_figure(const ModesResult& modes);

}  // namespace whine
