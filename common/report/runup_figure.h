// Run-ups: the spectrogram of the mesh force, orders of the transmission error over the speed, tooth loads and loss of contact.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/response.h"
#include "results/runup.h"

namespace whine {

// sweeps: of the same torque, up and down or none: their first harmonics, at which a slow ramp must arrive, stand beside the
// orders. Throws Error(input) for a sweep of another torque or a ramp too short for a window.
Figure runup_figure(const RunupResult& a, const std::vector<ResponseResult>& sweeps);

}  // namespace whine
