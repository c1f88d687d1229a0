// Run-ups: the spectrogram of the mesh force, orders of the transmission error over the speed, tooth loads and loss of contact.
#pragma once
#include <vector>

#include "report/figures.h"
#include "signal/response_result.h"
#include "studies/runup_result.h"

namespace whine {

// sweeps: of the same torque, up and down or none: their first harmonics, at which a slow ramp must arrive, stand beside the
// orders. Throws Error(input) for a sweep of another torque or a ramp too short for a window.
Figure runup_figure(const RunupArtifact& a, const std::vector<ResponseArtifact>& sweeps);

}  // namespace whine
