// Speed sweeps of a system, as those of a pair: by SpeedSweep of studies/speed_sweep.h.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/sweep.h"

namespace whine {

// bodies: [gear] of settings.body. Statics of lines come first: they give the mean stiffnesses, to which the dampers of the axes
// refer, and how far tip edges are looked for. report(done, total, note) is called after each speed. A speed at which the motion
// does not become periodic is kept with period_multiple 0. jump_width: Hz, as of sweep(), where the RMS over the meshes steps; of teeth
// that differ jumps are not looked for. Throws as system_at_rest() and SystemDynamics, with the speed.
SweepResult system_sweep(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                         Direction direction,
                         const std::function<void(long, long, const std::string&)>& report,
                         double jump_width = 0);

}  // namespace whine
