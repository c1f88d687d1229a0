// The periodic motion that a rolling pair settles into at one speed.
#pragma once
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/dynamics.h"

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

// How the change of a state in a period depends on the state, as the last periods have shown it: of neighbouring speeds nearly
// the same, so a speed begins with what the one before it has shown.
class AndersonAcceleration {
 public:
  void forget() { *this = {}; }
  // What comes is of another speed, or does not go on from what was taken last.
  void interrupt() { last_.reset(); }
  void take(const RollingDynamics& dynamics, const RollingDynamics::State& start,
            const RollingDynamics::State& end);
  bool ready() const;  // for propose()
  // Where the change vanishes, as far as the acceleration's columns see it (Anderson's method; Fang and Saad, Numer. Linear
  // Algebra Appl. 16 (2009) 197, type II). Nothing if a multiplier that they show is not inside the unit circle: what lies
  // there is no orbit that integration could find.
  std::optional<RollingDynamics::State> propose() const;

 private:
  struct Turn {
    RollingDynamics::State start, end;
    Eigen::VectorXd change;
  };
  struct AndersonColumn {  // differences of two turns
    RollingDynamics::State end;
    Eigen::VectorXd start, change;
  };
  std::optional<Turn> last_;
  int in_a_row_ = 0;  // turns, each from where the one before it ended
  std::deque<AndersonColumn> known_;
};

// Integrates from `state` until it repeats to `periodicity` (relative, RollingDynamics::distance) over a hunting period, which
// is a mesh period for teeth that are alike; `state` is then at the start of a mesh period on the orbit. method integrate:
// plain integration, as a rig would. extrapolate: once the motion is close, Anderson acceleration of the map that a period is
// takes its slow multipliers out. It is used only where these lie inside the unit circle, and a state that they propose counts
// only if integrating on comes closer still: an unstable orbit is left again. Of teeth that are alike a motion whose RMS leaves
// `looked_for` is given up, not periodic, its last period as it is; with `looked_for` no energy balance is recorded. Empty if
// contact leaves the candidate zone; the state is then undefined. shared: columns of a speed nearby to begin
// with, then of this one.
std::optional<Orbit> iterate_to_orbit(RollingDynamics& dynamics, RollingDynamics::State& state,
                                      double periodicity, SteadyState method, const RmsRange& looked_for = {},
                                      AndersonAcceleration* shared = nullptr);

// A state on the orbit of one mesh period at a speed.
struct KnownOrbit {
  double mesh_frequency = 0;  // Hz
  RollingDynamics::State state;
};

// The state to start from at a mesh frequency (Hz) so as to stay on the branch of up to three orbits, the last one nearest:
// state and speed as quadratics of the way along the branch, which a fold does not stop. The last orbit's own state where
// they do not reach that far.
RollingDynamics::State predicted(const RollingDynamics& dynamics, const std::vector<KnownOrbit>& branch,
                                 double mesh_frequency);

}  // namespace whine
