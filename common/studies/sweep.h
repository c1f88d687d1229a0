// Speed sweeps of pairs and trains: the state is carried from speed to speed, as on a test rig, and each speed runs until it is periodic, by
// SpeedSweep of studies/speed_sweep.h.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/static.h"
#include "results/sweep.h"
#include "signal/branches.h"
#include "signal/jumps.h"
#include "system/statics.h"

namespace whine {

// statics: of the same torque and contact; it gives mesh, contact discretisation and torque. mean_stiffness: N m-1, sets
// the bearing dampers. direction: "up" or "down". report(done, total, note) is called after each speed.
// A speed at which the motion does not become periodic is kept with period_multiple 0. left_early: takes the motions on
// branches between the speeds at which the sweep left them and their ends, if given. jump_width: Hz, jumps are enclosed to that or
// less; 0: to 1/64 of the step of the speeds. Throws Error(input) for
// parameters that do not fit, Error(numerical), with speed and mesh phase, if contact leaves the flanks or has no certified
// solution.
SweepResult sweep(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                  double mean_stiffness, const SweepParameters& settings, Direction direction,
                  const std::function<void(long, long, const std::string&)>& report,
                  std::vector<BranchPoint>* left_early = nullptr, double jump_width = 0);

// The same of a train. bodies: [gear] of settings.body. Statics of lines come first: they give the mean stiffnesses, to which the dampers of
// the axes refer, and how far tip edges are looked for. Jumps are looked for where the RMS over the meshes steps; of several meshes with teeth
// that differ they are not. Throws as system_at_rest() and SystemDynamics, with the speed.
SweepResult system_sweep(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                         Direction direction,
                         const std::function<void(long, long, const std::string&)>& report,
                         double jump_width = 0);

// Throws Error(input) for a width of jumps (Hz) that is neither 0, which stands for 1/64 of the step, nor 1e-5 or more.
void require_jump_width(double jump_width);
void store_jumps(const std::vector<BranchJump>& jumps, Eigen::VectorXd& frequency, Eigen::VectorXd& width);

// Time steps per mesh period at a mesh frequency (Hz): steps_per_period, doubled until the sampling rate is the least that is
// asked for. Throws Error(input) if that is more than 65536.
int steps_at(const TimeDiscretisation& time, double mesh_frequency);

// Damping ratio that eta of Eq. 21 alone gives the pair on its mean mesh stiffness k: eta w / 2 with w^2 = k (r1^2 / I1 +
// r2^2 / I2). An estimate from above: flexibility that follows its load at once is not damped.
double stiffness_damping_ratio(const StaticResult& statics, const Damping& damping,
                               const std::array<double, kSides>& inertia);

// What is out of the ordinary in the numbers of a scene that only motions need: a damping that nobody chose for these gears,
// inertias a hundred times those of the drawing. inertia: (gear) kg m2.
std::vector<Remark> setup_remarks(const StaticResult& statics, const std::array<double, kSides>& inertia,
                                  const Damping& damping, const Fidelity& fidelity);

// What a reader of a sweep of elastic gears has to know beside its numbers, in words: a default damping that is not for these
// gears, steps too long for the contact, motions that do not repeat or after several mesh periods, backlash used up. `statics`
// is of the same torque.
std::vector<Remark> remarks(const SweepResult& sweep, const StaticResult& statics);

// (speed) m: by how little the flanks of a pair close along the line of action at least, of its samples: the transmission error less what
// elastic bearings give way. Their dampers' forces are taken for those of their springs.
Eigen::VectorXd least_closing(const SweepResult& sweep);

// (speed) m: backlash that the motion leaves, below 0 where back flanks would touch, which is not modelled; infinite where the
// scene counts no backlash.
Eigen::VectorXd backlash_left(const SweepResult& sweep);

// Time steps per oscillation at the natural frequency, at the speed with the fewest.
double steps_per_oscillation(const SweepResult& sweep);

}  // namespace whine
