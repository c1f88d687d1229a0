#include "studies/branch_follower.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "dynamics/steady_state.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr int kMostSegments = 64;

BranchSettings branch_settings(const SweepParameters& stage_settings, int steps, bool at_folds) {
  BranchSettings settings;
  settings.low = stage_settings.frequency_from;
  settings.high = stage_settings.frequency_to;
  settings.scale = 0.5 * (settings.low + settings.high);
  // Speeds at which the number of steps changes.
  const TimeDiscretisation& time = stage_settings.time;
  if (steps > time.steps_per_period)
    settings.high = std::min(settings.high, 2 * time.min_sample_rate / steps);
  if (time.min_sample_rate > 0) settings.low = std::max(settings.low, time.min_sample_rate / steps);
  settings.first_step = 0.02;
  settings.largest_step = at_folds ? 0.25 : 0.06;
  settings.straight = at_folds ? 0.95 : 0.99;
  settings.location = 1e-6;
  settings.fold_location = at_folds ? 1e-5 : 1e-8;
  settings.grazing_location = at_folds ? 1 : 0.05;
  settings.orbit.tolerance = 1e-9;
  return settings;
}

}  // namespace

BranchFollower::BranchFollower(RollingDynamics& dynamics, const GearMeshModel& model,
                               const StaticArtifact& statics, const SweepParameters& settings, Look look)
    : dynamics_(dynamics),
      model_(model),
      statics_(statics),
      settings_(settings),
      look_(look),
      finest_(steps_at(settings.time, settings.frequency_from)) {}

std::vector<BranchSegment> BranchFollower::follow(
    const std::function<void(long, long, const std::string&)>& report) {
  const double low = settings_.frequency_from, high = settings_.frequency_to;
  int steps = steps_at(settings_.time, high), direction = -1;
  begin(high, steps);
  const long total = std::max(1l, std::lround((high - low) / settings_.frequency_step));
  double lowest = high;
  std::vector<BranchSegment> segments;
  for (;;) {
    segments.push_back(
        {follow_branch(*map_, orbit_, direction, branch_settings(settings_, steps, look_ == Look::at_folds),
                       [&](const BranchPosition& p) {
                         map_->take_left_zone();  // beside the orbit
                         lowest = std::min(lowest, p.parameter);
                         report(std::lround((high - lowest) / (high - low) * total), total,
                                text(p.parameter, " Hz"));
                       }),
         steps});
    const OrbitBranch& branch = segments.back().branch;
    const BranchPosition& last = branch.points.back();
    const double at = last.parameter;
    direction = last.turn > 0 ? 1 : -1;
    if (static_cast<int>(segments.size()) == kMostSegments) return segments;
    if (!branch.reached_limit) {
      if (!map_->take_left_zone()) return segments;
      widen();
    } else {
      if (direction > 0 ? at >= high : at <= low) return segments;
      steps = direction > 0 ? steps / 2 : steps * 2;
    }
    resume(last.start, at, steps, !branch.reached_limit);
  }
}

void BranchFollower::widen() {
  if (++level_ > kMostZoneLevel)
    fail_outside_range(Failure::numerical, "contact leaves the flanks: forces above ",
                       MotionBounds(model_, statics_, std::pow(kWidening, kMostZoneLevel)).force,
                       " N; lower the torque");
  dynamics_.set_zone(zone_of_level(model_, statics_, level_), finest_);
}

// The orbit into which the pair settles.
void BranchFollower::begin(double at, int steps) {
  for (level_ = -1; !map_;) {
    widen();
    map_ = std::make_unique<RollingPeriodMap>(dynamics_, steps);
    map_->set_parameter(at);
    RollingDynamics::State state = dynamics_.rest();
    const auto periodic =
        find_periodic_orbit(dynamics_, state, settings_.time.periodicity, SteadyState::extrapolate);
    if (!periodic) {
      map_.reset();
      continue;
    }
    if (periodic->multiple != 1)
      fail(Failure::numerical, "at ", at, " Hz, where the branch begins, the motion ",
           periodic->multiple == 0 ? text("does not repeat within ", periodic->periods, " mesh periods")
                                   : text("repeats after ", periodic->multiple, " mesh periods"),
           "; give mesh_frequency_Hz another upper end");
    if (!found(map_->flat(state), at, steps)) map_.reset();
  }
}

// With other steps or another zone: the orbit near that of before.
void BranchFollower::resume(const VectorXd& start, double at, int steps, bool wider) {
  RollingDynamics::State state = map_->state(start);
  for (;;) {
    map_ = std::make_unique<RollingPeriodMap>(dynamics_, steps);
    map_->set_parameter(at);
    RollingDynamics::State near = state;
    RollingDynamics::Period period;
    // A period puts the contact forces where this zone has its strips.
    if (dynamics_.integrate(near, period) && found(map_->flat(near), at, steps)) break;
    widen();
    wider = true;
  }
  // In another zone the contact forces stand elsewhere.
  if (!wider) mismatch_.push_back((orbit_.start - start).norm() / start.norm());
}

// Newton's method; false where contact leaves the zone.
bool BranchFollower::found(const VectorXd& start, double at, int steps) {
  OrbitSettings settings;
  settings.tolerance = 1e-9;
  const OrbitSearch search = find_orbit(*map_, start, 1, settings);
  if (search.found()) {
    orbit_ = search.orbit;
    return true;
  }
  if (map_->take_left_zone()) return false;
  fail(Failure::numerical, "at ", at, " Hz no orbit of ", steps,
       " steps is found from that at hand: ", search.failure);
}

}  // namespace whine
