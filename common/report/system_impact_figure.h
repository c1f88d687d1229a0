// Damping and natural frequencies of the modes of a system by ring-down.
#pragma once
#include "report/figures.h"
#include "results/system_impact.h"

namespace whine {

// Damping ratio over natural frequency: of each mode the decays (mean and range over the mesh phases) and the eigenvalues,
// Rayleigh's damping alone, and the natural frequencies of rigid gears. Throws Error(input) if no mode oscillates.
Figure system_impact_figure(const SystemImpactResult& a);

}  // namespace whine
