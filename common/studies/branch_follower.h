// Follows the branch of a pair's periodic orbits over the mesh frequency, in segments of one number of steps per period and one
// candidate contact zone.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/period_map.h"
#include "orbits/branch.h"
#include "studies/zone_levels.h"

namespace whine {

struct BranchSegment {
  OrbitBranch branch;
  int steps = 0;  // per period
};

class BranchFollower {
 public:
  // How closely: with all that happens on the way, or for a first look at the folds, with long steps, no grazing orbits and
  // folds to 1e-5 of their speed.
  enum class Look { close, at_folds };
  // All must live as long as this. settings: speeds, time discretisation. Nobody else may use the dynamics meanwhile.
  BranchFollower(RollingDynamics& dynamics, const GearMeshModel& model, const StaticArtifact& statics,
                 const SweepParameters& settings, Look look = Look::close);

  // From the orbit into which the pair settles at the highest speed, towards lower ones and round the folds, until it leaves the
  // speeds or ends. report(done, total, note) is called after each point, in steps of the speeds. Throws Error(numerical) if the
  // pair does not settle into an orbit of one mesh period, ModelRangeError if contact leaves the flanks.
  std::vector<BranchSegment> follow(const std::function<void(long, long, const std::string&)>& report);
  // (change of steps) relative change of the orbit there.
  const std::vector<double>& mismatch() const { return mismatch_; }
  int level() const { return level_; }  // of the zone, at last

 private:
  void widen();
  void begin(double at, int steps);
  void resume(const Eigen::VectorXd& start, double at, int steps, bool wider);
  bool found(const Eigen::VectorXd& start, double at, int steps);

  RollingDynamics& dynamics_;
  const GearMeshModel& model_;
  const StaticArtifact& statics_;
  const SweepParameters& settings_;
  Look look_;
  int finest_, level_ = -1;
  std::unique_ptr<RollingPeriodMap> map_;
  PeriodicOrbit orbit_;
  std::vector<double> mismatch_;
};

}  // namespace whine
