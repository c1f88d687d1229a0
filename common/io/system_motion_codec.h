// What artifacts of systems in motion have in common: bodies, meshes, torques, damping, model levels, discretisation of time.
//
// Private to the layer io/.
#pragma once
#include "io/layout_codec.h"
#include "results/system_sweep.h"

namespace whine {

class Codec;

void describe_system(Codec& codec, SystemSweepParameters& settings, Eigen::VectorXd& torque,
                     const LayoutPlace& place = {});
// The same with axis_frequency: Hz, as axis_frequency() gives it.
void describe_system_motion(Codec& codec, SystemSweepParameters& settings, Eigen::VectorXd& torque,
                            double& axis_frequency);
void describe_time_steps(Codec& codec, TimeDiscretisation& time);

}  // namespace whine
