// Where the primary resonance of a pair has two branches, where its teeth part, and what they carry, against damping: speed
// sweeps up and down for a series of damping ratios, with all that does not depend on damping computed once.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "dynamics/impact.h"
#include "results/jump_map.h"
#include "results/reduced_body.h"
#include "signal/branches.h"

namespace whine {

// Mesh phases at which states with fixed contact are looked at.
inline constexpr int kStatePhases = 128;

struct JumpMapPlan : MapSpeeds {
  // Cases: first these Rayleigh stiffness factors (s) as they are, then those factors that give these damping ratios with
  // two pairs in contact and the contact frozen.
  std::vector<double> rayleigh_stiffness, damping_ratio;
};

// statics: mesh with its corner rule, and contact, which is also that of settings.
// torque: N m.
// settings: as read_map_parameters gives it; its reference torque sets the bearing dampers, with the corner rule of the map.
// plan: default speeds follow from the natural frequency of the mean stiffness between rigid gears.
// report(done, total, note): called after each sweep.
// Result: ends of branches are the jumps that sweep() finds; where motions differ without a jump, the last speeds at which they do.
//   Peak loads, loads at load_frequency and contact loss include the motions of a branch beyond the speed at which the sweep left
//   it; loads at load_frequency are interpolated between these.
// Throws Error(input) for no case, a factor or ratio that is not positive, a ratio that bearings and mass-proportional damping exceed or
// no factor gives, an empty range of speeds or one without load_frequency, a pair that never has two tooth pairs in contact; other
// errors as static_transmission, fixed_phase_states and sweep.
JumpMapResult jump_map(const ReducedBody& driver, const ReducedBody& driven, const StaticParameters& statics,
                       double torque, const SweepParameters& settings, const JumpMapPlan& plan,
                       const std::function<void(long, long, const std::string&)>& report);

// eta (s) of Eq. 21 that gives the damping ratio to the pair at a fixed phase, whose undamped frequency (Hz) this is. Throws
// Error(input) if bearings and mass-proportional damping exceed the ratio or no factor gives it.
double rayleigh_stiffness_for(double ratio, const FixedPhaseMesh& mesh, BodyModel body, double frequency);

}  // namespace whine
