// Follows the branch of a motion's periodic orbits over the mesh frequency, in segments of one number of steps per period and one
// set of candidate contacts.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/motion.h"
#include "model/stages.h"
#include "orbits/branch.h"

namespace whine {

inline constexpr int kKeptMultipliers = 8;  // of each orbit of a branch
inline constexpr int kMostSegments = 64;    // of a branch
// Of the frequency: least width of folds, period doublings and tori of a map with time steps. Half the step moves them by up to 0.3 %
// (README of orbits), of which nothing shows at the point itself.
inline constexpr double kStepError = 3e-3;
// That a branch ends because it has as many, or because no orbit is found beyond a change of steps: a fold may lie in between.
void note_most_segments(OrbitBranch& branch);
void note_steps_change(OrbitBranch& branch, const std::string& failure);

// The speeds (Hz) between which a branch of [from, to] has this number of steps per period, and the scale of all of it.
BranchSettings segment_speeds(const TimeDiscretisation& time, double from, double to, int steps);
// The steps per period of the segment that goes on where a branch of [from, to] has left one with `steps`; nothing where it has left
// [from, to].
std::optional<int> steps_beyond(const TimeDiscretisation& time, double from, double to, int steps,
                                const OrbitBranch& branch);

// What of a branch is followed.
struct BranchPlan {
  std::optional<Direction> sweep = {};  // begins with the motion of a sweep in this direction
  double at = 0;                        // Hz, of that motion
  double tolerance = 1e-9;              // of an orbit's residual, 1e-12 to 1e-3
  int most_periods = 1;  // 2 or 4: branches beyond period doublings too, up to orbits of so many periods
};

struct BranchSegment {
  OrbitBranch branch;
  int steps = 0;     // per period
  int multiple = 1;  // periods after which its orbits repeat
  int part = 0;      // segments of one part follow each other along the arc
  // (special) of branch.special: the state there, which any set of candidate contacts can go on from
  std::vector<MotionState> special_state{};
  // (special) mesh, from 0, and tooth pair of the contact of its event, by the names of these candidate contacts
  std::vector<std::pair<int, int>> special_place{};
};

class BranchFollower {
 public:
  using State = MotionState;
  using Segment = BranchSegment;
  using Report = std::function<void(long, long, const std::string&)>;
  // How closely: with all that happens on the way, or for a first look at the folds, with long steps, no grazing orbits and
  // folds to 1e-5 of their speed.
  enum class Look { close, at_folds };
  // The motion must live as long as this.
  BranchFollower(Motion& motion, const MotionSettings& speeds, Look look = Look::close,
                 double tolerance = kOrbitTolerance);
  static constexpr double kOrbitTolerance = 1e-9;  // of an orbit's residual

  // What the plan says. report(done, total, note) is called after each point, in steps of the speeds. Throws Error(input) for a plan
  // or speeds out of range, else as what follows.
  const std::vector<Segment>& follow(const BranchPlan& plan, const Report& report);
  // From the orbit into which the motion settles at the highest speed, towards lower ones and round the folds, until it leaves the
  // speeds or ends. Throws Error(numerical) if it does not settle into an orbit of one mesh period, ModelRangeError if contact leaves
  // the flanks.
  const std::vector<Segment>& follow(const Report& report);
  // From the motion that a sweep in a direction has at a speed, which may repeat after several periods, both ways: two parts.
  // The branch may close on itself; then it is one.
  const std::vector<Segment>& follow_from_sweep(Direction direction, double at, const Report& report);
  // Branches that begin at the flips of these segments, and at their flips, up to orbits of `most` periods: a part each, added to
  // them. Of a flip beside which no orbit of twice the periods is found a part without points says why.
  void follow_flips(int most, const Report& report);
  // (change of steps) relative change of the orbit there.
  const std::vector<double>& mismatch() const { return mismatch_; }
  // Of each orbit, its peaks; to be said before the branch is followed.
  void measure(MotionMap::Measure of) { measure_ = std::move(of); }

 private:
  void run(int steps, int direction, int part, const Report& report);
  void begin_swept(Direction direction, double at);
  void follow_flip(size_t of, size_t flip, const Report& report);
  void widen(State& state);
  void new_map(double at, int steps);
  std::optional<MotionRecord> settle(State& state, double at, int steps, SteadyState method);
  void begin(double at, int steps);
  void resume(State state, const Eigen::VectorXd& start, double at, int steps, bool wider);
  bool found(const Eigen::VectorXd& start, double at, int steps);

  Motion& motion_;
  const MotionSettings speeds_;
  Look look_;
  double tolerance_;
  int multiple_ = 1;
  bool closed_ = false;  // the part followed last, on itself
  std::unique_ptr<MotionMap> map_;
  MotionMap::Measure measure_;
  PeriodicOrbit orbit_;
  std::vector<double> mismatch_;
  std::vector<Segment> segments_;
  std::optional<State> kept_;  // to go on from, the other way
};

// Why each part of a branch ends, one after the other.
std::string ends_of(const std::vector<BranchSegment>& segments);

}  // namespace whine
