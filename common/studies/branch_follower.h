// Follows the branch of a pair's periodic orbits over the mesh frequency, in segments of one number of steps per period and one
// candidate contact zone.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/period_map.h"
#include "model/stages.h"
#include "orbits/branch.h"
#include "studies/zone_levels.h"

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

struct BranchSegment {
  OrbitBranch branch;
  int steps = 0;     // per period
  int multiple = 1;  // periods after which its orbits repeat
  int part = 0;      // segments of one part follow each other along the arc
  // (special) of branch.special: the state there, which any candidate zone can go on from
  std::vector<RollingDynamics::State> special_state{};
};

class BranchFollower {
 public:
  // How closely: with all that happens on the way, or for a first look at the folds, with long steps, no grazing orbits and
  // folds to 1e-5 of their speed.
  enum class Look { close, at_folds };
  // All must live as long as this. settings: speeds, time discretisation. Nobody else may use the dynamics meanwhile.
  BranchFollower(RollingDynamics& dynamics, const GearMeshModel& model, const StaticResult& statics,
                 const SweepParameters& settings, Look look = Look::close,
                 double tolerance = kOrbitTolerance);
  static constexpr double kOrbitTolerance = 1e-9;  // of an orbit's residual

  // From the orbit into which the pair settles at the highest speed, towards lower ones and round the folds, until it leaves the
  // speeds or ends. report(done, total, note) is called after each point, in steps of the speeds. Throws Error(numerical) if the
  // pair does not settle into an orbit of one mesh period, ModelRangeError if contact leaves the flanks.
  std::vector<BranchSegment> follow(const std::function<void(long, long, const std::string&)>& report);
  // From the motion that a sweep in a direction has at a speed, which may repeat after several periods, both ways: two parts.
  // The branch may close on itself; then it is one.
  std::vector<BranchSegment> follow_from_sweep(
      Direction direction, double at, const std::function<void(long, long, const std::string&)>& report);
  // Branches that begin at the flips of these segments, and at their flips, up to orbits of `most` periods: a part each, added to
  // them. Of a flip beside which no orbit of twice the periods is found a part without points says why.
  void follow_flips(std::vector<BranchSegment>& segments, int most,
                    const std::function<void(long, long, const std::string&)>& report);
  // (change of steps) relative change of the orbit there.
  const std::vector<double>& mismatch() const { return mismatch_; }
  // Of each orbit, its peaks; to be said before the branch is followed.
  void measure(RollingPeriodMap::Measure of) { measure_ = std::move(of); }
  int level() const { return level_; }  // of the zone, at last

 private:
  using Report = std::function<void(long, long, const std::string&)>;
  void run(int steps, int direction, int part, const Report& report, std::vector<BranchSegment>& segments);
  void begin_swept(Direction direction, double at);
  void follow_flip(const BranchSegment& from, size_t flip, const Report& report,
                   std::vector<BranchSegment>& segments);
  void widen();
  void new_map(int steps);
  void begin(double at, int steps);
  void resume(const RollingDynamics::State& state, const Eigen::VectorXd& start, double at, int steps,
              bool wider);
  bool found(const Eigen::VectorXd& start, double at, int steps);

  RollingDynamics& dynamics_;
  const GearMeshModel& model_;
  const StaticResult& statics_;
  const SweepParameters& settings_;
  Look look_;
  double tolerance_;
  int finest_, level_ = -1, multiple_ = 1;
  bool closed_ = false;  // the part followed last, on itself
  std::unique_ptr<RollingPeriodMap> map_;
  RollingPeriodMap::Measure measure_;
  PeriodicOrbit orbit_;
  std::vector<double> mismatch_;
};

}  // namespace whine
