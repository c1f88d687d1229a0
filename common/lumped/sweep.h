// Steady motions of a lumped model, and its speed sweeps in the protocol of the elastic gears: the state is carried from
// speed to speed and integrated, as on a test rig. Once close to an orbit, Newton's method on the period map, whose derivative
// is exact, takes the rest of the transient, unless the orbit is unstable or far.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lumped/oscillator.h"
#include "results/jump_map.h"
#include "results/static.h"
#include "results/sweep.h"
#include "signal/branches.h"

namespace whine {

struct LumpedOrbit {
  LumpedOscillator::State start;  // at phase 0
  int multiple = 0;               // mesh periods of the orbit; 0: not periodic within the limit
  int periods = 0;                // run on the way
  double residual = 0;            // size of the change of the state over the orbit, over that of the state
  LumpedOscillator::Matrix monodromy = LumpedOscillator::Matrix::Identity();  // over `multiple` periods
  double mean = 0, rms = 0;            // m: of x, of its oscillating part, from integrals over the pieces
  std::vector<LumpedRecord> record;    // (period) of the orbit; the last ones integrated if not periodic
  LumpedEnergyBalance energy_balance;  // of these periods
  double largest_multiplier() const;   // modulus
};

// Integrates from start until the state repeats: to `periodicity`, and far below it by Newton's method unless integrate_only.
LumpedOrbit iterate_to_orbit(LumpedOscillator& oscillator, const LumpedOscillator::State& start,
                             double periodicity, bool integrate_only, int most_periods = 3000);

// Where an orbit of `multiple` periods near start meets its unstable partner and both end: P(y) = y and a multiplier +1,
// as locate_fold() does. Leaves the oscillator at that speed. Nothing if it does not converge.
struct LumpedFold {
  double mesh_frequency;  // Hz
  LumpedOscillator::State start;
};
std::optional<LumpedFold> find_fold(LumpedOscillator& oscillator, const LumpedOscillator::State& start,
                                    double mesh_frequency, int multiple);

struct LumpedJump {
  double mesh_frequency, width;  // Hz
  bool fold;  // located by find_fold; otherwise the middle of the interval in which the branch ends
  LumpedOscillator::State start;  // of the orbit at the fold, or of the last one found on the branch
};
struct LumpedSpeeds {
  std::vector<LumpedOrbit> orbits;  // (speed)
  std::vector<LumpedJump> jumps;
  std::vector<BranchPoint> left_early;  // motions on the way to the ends of branches
};
// Through the speeds (Hz) in their order, from rest. A jump is where the branch that was left ends, beyond the speed at
// which the sweep left it, too, up to `limit`. report(done, total, note) is called after each speed.
LumpedSpeeds integrate_speeds(LumpedOscillator& oscillator, const std::vector<double>& speeds,
                              double periodicity, bool integrate_only,
                              const std::function<void(long, long, const std::string&)>& report);

// kg, of the relative rotation of two gears on their line of action: I1 I2 / (I1 r2^2 + I2 r1^2), r base radii, inertias in
// kg m2.
double reduced_mass(const StaticResult& statics, const std::array<double, kSides>& inertia);

struct LumpedOptions : MeshSpeeds {
  MotionModel model = MotionModel::rectangular;
  double mass = 0;              // kg
  double damping_ratio = 0.08;  // 1: c = 2 ratio sqrt(k_avg m), k_avg the mean of k(t)
  DamperActs damper_acts = DamperActs::always;
  Integrator integrator = Integrator::exact;
  TimeDiscretisation time;  // steps_per_period: stored samples, and least Newmark steps
  Direction direction = Direction::up;
};

// springs: cells only (lumped/stiffness.h). numbers: the tooth pair of each spring, several of one pair one after the
// other; a spring for the whole mesh is pair 0. left_early: takes the motions on the way to the ends of branches, if
// given. Fields of a sweep that only elastic bodies have are empty or 0; its inertias are those of equal shares of the mass.
// Throws Error(input) for values that make no model, Error(numerical) if a motion cannot be followed.
SweepResult lumped_sweep(const StaticResult& statics, LumpedParameters springs,
                         const Eigen::VectorXi& numbers, const LumpedOptions& options,
                         const std::function<void(long, long, const std::string&)>& report,
                         std::vector<BranchPoint>* left_early = nullptr);

// A map of jumps of the same model at the torque of the statics: a case per damping ratio, which is options' own, about the
// mean stiffness; its speeds and direction are not read. The map's model and damper are those of options; mean, first harmonic and frequencies are those of the springs that touch at rest. Loads are those
// of the whole mesh where it is one spring. Throws Error(input) for no case or a ratio outside (0, 1), and as
// map_speeds and lumped_sweep.
JumpMapResult lumped_jump_map(const StaticResult& statics, LumpedParameters springs,
                              const Eigen::VectorXi& numbers, LumpedOptions options, const MapSpeeds& speeds,
                              const std::vector<double>& damping_ratio,
                              const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
