// system_sweep.h5: periodic motions of a system of elastic gears over its speeds, rising or falling.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/system_sweep.h"

namespace whine {

class Codec;

// What artifacts of systems in motion have in common: bodies, meshes, torques, damping, model levels; Hz: axis_frequency(). And
// the discretisation of time.
void describe_system_motion(Codec& codec, SystemSweepParameters& settings, Eigen::VectorXd& torque,
                            double& axis_frequency);
void describe_time_steps(Codec& codec, TimeDiscretisation& time);

void describe(Codec& codec, SystemSweepResult& a);
void write(const std::string& path, const SystemSweepResult& a, const Provenance& provenance);
SystemSweepResult read_system_sweep(const std::string& path);

}  // namespace whine
