// Damping and natural frequencies by ring-down: of the mesh of a pair, of the modes of a train.
#pragma once
#include "report/figures.h"
#include "results/impact.h"

namespace whine {

// Damping ratio over natural frequency: of each mode the decays (mean and range over the mesh phases) and the eigenvalues,
// Rayleigh's damping alone; of a pair the decays of its contact states, of a train the natural frequencies of rigid gears. Throws
// Error(input) if no mode oscillates.
Figure impact_figure(const ImpactResult& a);

}  // namespace whine
