// A system that rolls at constant mean speed, whatever stepper moves it: the one thing that sweeps, branches and run-ups know of a motion.
//
// Two steppers stand behind it (table): of strips (strips_motion.h) and of lines (lines_motion.h). Calls are per mesh period or rarer.
// A motion is computed on a set of candidate contacts, which may turn out too small: settle(), integrate() and fit() then say so, and
// widen() takes the next larger set.
//
//   |                              | strips                                | lines                                          |
//   | meshes, bodies               | one mesh, two gears                   | any number                                     |
//   | contact of a tooth pair      | pressure over its width, or a line    | a line, or points of it in slices              |
//   | candidate contacts           | zones of growing width, in levels     | tip edges within growing gaps                  |
//   | smaller sets again           | narrow()                              | no: what is looked for and does not touch changes no force |
#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "dynamics/dynamics.h"
#include "dynamics/motion_period.h"
#include "dynamics/steady_state.h"
#include "dynamics/system_dynamics.h"
#include "orbits/period_map.h"
#include "orbits/periodic_motion.h"

namespace whine {

// Of the stepper that made it.
using MotionState = std::variant<RollingDynamics::State, SystemDynamics::State>;

// What a motion settled into.
struct MotionRecord {
  int multiple = 0;     // mesh periods after which it repeats; 0: it does not
  int periods = 0;      // mesh periods integrated before those recorded
  double residual = 0;  // relative change of the state over it
  double rms = 0;       // m, of the oscillating transmission errors, norm over the meshes
  std::vector<MotionPeriod>
      record;  // one orbit, or the last periods; where there are several, each begins with its own start
  EnergyBalance energy;         // of the recorded periods
  Eigen::VectorXd coefficient;  // (mesh) 1: of friction; empty: none acts
  double power_in = 0;  // W, with friction: of what drives, and of what holds bodies that turn on the ground
  Eigen::RowVectorXd holding_torque;  // (body) N m, of lines: mean, of what holds the body; 0 of free ones
};

// What the runs of one speed show for the next.
struct MotionAcceleration {
  RollingAcceleration strips;
  AndersonAcceleration<FlatStates> lines;
  int level = 0;  // of the candidate contacts that `lines` is of
  void forget() { *this = {}; }
};

// The period map of a motion on its present candidate contacts.
class MotionMap : public PeriodMap {
 public:
  explicit MotionMap(int steps) : steps_(steps) {}
  int steps() const { return steps_; }
  // Whether contact left the candidates in any period since the last call.
  bool take_left_zone() { return std::exchange(left_zone_, false); }
  // What peaks() are of a period and those before it, with its number and those of the orbit.
  using Measure = std::function<Eigen::VectorXd(const MotionPeriod&, int, int)>;
  void measure(Measure of) { measure_ = std::move(of); }
  Eigen::VectorXd peaks(int number, int periods) override {
    return measure_ ? measure_(shown(), number, periods) : Eigen::VectorXd();
  }
  virtual MotionPeriod shown() const = 0;  // the mesh period applied last
  virtual Eigen::VectorXd flat_of(const MotionState& state) const = 0;
  virtual MotionState state_of(const Eigen::VectorXd& y) const = 0;
  // Of a contact of events(): its mesh, from 0, and its tooth pair.
  virtual std::pair<int, int> place_of(int contact) const = 0;

 protected:
  bool left_zone_ = false;
  int steps_;

 private:
  Measure measure_;
};

class Motion {
 public:
  using State = MotionState;
  virtual ~Motion() = default;
  virtual const SystemModel& system() const = 0;
  virtual int hunting_periods() const = 0;  // see hunting_periods() of the system
  // Hz: mean over the mesh period with the contact frozen as the static load leaves it; of lines that of the mode that gives way most to
  // the torque of the input.
  virtual double natural_frequency() = 0;
  // Of a pair: N m s, damper of the axis of gear g.
  virtual double axis_damper(int g) = 0;

  virtual int reach() const = 0;  // largest |pair| that the candidates so far can touch

  // Static equilibrium at phase 0.
  virtual State rest() = 0;
  // From a state until the motion repeats to `periodicity`, at a mesh frequency (Hz). Nothing if contact leaves the candidates; the
  // state is then undefined. Throws as iterate_to_orbit().
  struct Settling {
    double periodicity = 1e-5;
    SteadyState method = SteadyState::extrapolate;
    RmsRange looked_for = {};  // as iterate_to_orbit() of steady_state.h takes it; lines are not given up
    bool recorded = true;      // false: RMS and record may be left out
  };
  virtual std::optional<MotionRecord> settle(State& state, double mesh_frequency, int steps,
                                             const Settling& how, MotionAcceleration* shared = nullptr) = 0;
  // The state to start from so as to stay on the branch of these orbits, see predicted() of orbits/iteration.h.
  virtual State predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency, int steps) = 0;
  // A speed that is left after a few periods, and periods at it. False if contact leaves the candidates; the state is then undefined.
  virtual void pass_speed(double mesh_frequency, int steps) = 0;
  virtual bool integrate(State& state, MotionPeriod& period) = 0;
  virtual std::unique_ptr<MotionMap> map(int steps) = 0;

  // The next set of candidate contacts; the states fit it then. Throws ModelRangeError beyond the last one.
  virtual void widen(const std::vector<State*>& states) = 0;
  // The set before it. False where there is none, or where the present one computes the same.
  virtual bool narrow() { return false; }
  virtual int level() const { return 0; }
  virtual int most_level() const = 0;
  virtual void restore(int /*level*/) {}  // after narrow() or widen(), where that can be undone
  // Contact forces where these candidates have their strips: an orbit puts them there in the periods after which it repeats, at the
  // speed of the map made last. False if contact leaves the candidates.
  virtual bool fit(State& /*state*/, int /*periods*/) { return true; }
};

}  // namespace whine
