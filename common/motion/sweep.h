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
// parameters that do not fit, Error(numerical) if contact leaves the flanks.
SweepArtifact sweep(const BodyArtifact& driver, const BodyArtifact& driven, const StaticArtifact& statics,
                    double mean_stiffness, const SweepSlice& slice, const std::string& direction,
                    const std::function<void(long, long, const std::string&)>& report,
                    std::vector<BranchPoint>* left_early = nullptr);

// Largest load (N) that one pair carries through 1/64 of a mesh period without a break; load: (sample, pair), whole periods
// of `samples`.
double held_load(const Eigen::Ref<const MatrixRM>& load, int samples);

// Whether the RMS of the transmission error of two motions differ as much as across a jump.
bool like_a_jump(double rms, double other);

}  // namespace whine
