// Speed sweeps: the state is carried from speed to speed, as on a test rig, and each speed runs until it is
// periodic.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "files/schemas.h"

namespace whine {

// A motion on a branch that the sweep had left too early, met on the way to the branch's end.
struct BranchPoint {
  double mesh_frequency = 0;  // Hz
  double dte_rms = 0;         // m
  double tooth_load_max = 0;  // N
  double held_load = 0;       // N, see held_load()
  bool parted = false;        // contact is lost during the period
};

// statics: of the same torque and contact; it gives mesh, contact discretisation and torque. mean_stiffness: N m-1, sets
// the bearing dampers. direction: "up" or "down". report(done, total, note) is called after each speed.
// A speed at which the motion does not become periodic is kept with period_multiple 0. left_early: takes the motions on
// branches between the speeds at which the sweep left them and their ends, if given. Throws Error(input) for
// parameters that do not fit, Error(numerical), with speed and mesh phase, if contact leaves the flanks or has no certified
// solution.
SweepArtifact sweep(const BodyArtifact& driver, const BodyArtifact& driven, const StaticArtifact& statics,
                    double mean_stiffness, const SweepSlice& slice, const std::string& direction,
                    const std::function<void(long, long, const std::string&)>& report,
                    std::vector<BranchPoint>* left_early = nullptr);

// Largest load (N) that one pair carries through 1/64 of a mesh period without a break; load: (sample, pair), whole periods
// of `samples`.
double held_load(const Eigen::Ref<const MatrixRM>& load, int samples);

// Damping ratio that eta of Eq. 21 alone gives the pair on its mean mesh stiffness k: eta w / 2 with w^2 = k (r1^2 / I1 +
// r2^2 / I2). An estimate from above: flexibility that follows its load at once is not damped.
double stiffness_damping_ratio(const StaticArtifact& statics, const SweepSlice& slice);

// Time steps per oscillation at the natural frequency, at the speed with the fewest.
double steps_per_oscillation(const SweepArtifact& sweep);

}  // namespace whine
