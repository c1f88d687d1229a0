// The periodic motion that a rolling pair settles into at one speed.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/dynamics.h"
#include "orbits/iteration.h"

namespace whine {

// One orbit of `multiple` mesh periods, whole hunting periods of teeth that differ; 0: the motion did not become periodic and
// `record` holds the last periods.
struct Orbit {
  int multiple = 1;
  int periods = 0;               // mesh periods integrated before those recorded
  double residual = 0;           // relative change of the state over the orbit
  double rms = 0;                // m, of the oscillating transmission error
  EnergyBalance energy_balance;  // of the recorded periods
  std::vector<RollingDynamics::Period> record;
};

// What the RMS of a mesh period (m) may be of a motion that is looked for.
struct RmsRange {
  double least = 0, most = std::numeric_limits<double>::infinity();
};

// The states of a rolling pair, for iterate().
struct RollingStates {
  using State = RollingDynamics::State;
  static constexpr int kColumns = 2;  // as many multipliers go at once: the slowest two, of one resonance
  RollingDynamics& dynamics;

  Eigen::VectorXd difference(const State& a, const State& b) const { return dynamics.difference(a, b); }
  double distance(const State& a, const State& b) const { return dynamics.distance(a, b); }
  // Sum of weight times state. States of another range know more or fewer teeth than the last, or have other strips, whose
  // forces are then those of the last; only an energy balance reads them.
  static State combination(const std::vector<const State*>& states, const Eigen::VectorXd& weight);
};
using RollingAcceleration = AndersonAcceleration<RollingStates>;

// Integrates from `state` until it repeats to `periodicity` (relative, RollingDynamics::distance) over a hunting period, which
// is a mesh period for teeth that are alike; `state` is then at the start of a mesh period on the orbit. method integrate:
// plain integration, as a rig would; extrapolate: with Anderson's method, see iterate(). Of teeth that are alike a motion whose
// RMS leaves `looked_for` is given up, not periodic, its last period as it is; with `looked_for` no energy balance is recorded.
// Empty if contact leaves the candidate zone; the state is then undefined. shared: columns of a speed nearby to begin with, then
// of this one.
std::optional<Orbit> iterate_to_orbit(RollingDynamics& dynamics, RollingDynamics::State& state,
                                      double periodicity, SteadyState method, const RmsRange& looked_for = {},
                                      RollingAcceleration* shared = nullptr);

}  // namespace whine
