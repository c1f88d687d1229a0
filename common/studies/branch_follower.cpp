#include "studies/branch_follower.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "dynamics/steady_state.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::VectorXd;

BranchSettings segment_speeds(const TimeDiscretisation& time, double from, double to, int steps) {
  BranchSettings settings;
  settings.low = from;
  settings.high = to;
  settings.scale = 0.5 * (settings.low + settings.high);
  if (steps > time.steps_per_period)
    settings.high = std::min(settings.high, 2 * time.min_sample_rate / steps);
  if (time.min_sample_rate > 0) settings.low = std::max(settings.low, time.min_sample_rate / steps);
  return settings;
}

void note_steps_change(OrbitBranch& branch, const std::string& failure) {
  branch.end += text(", where the steps per mesh period change, and is followed no further: ", failure,
                     "; raise steps_per_period or lower min_sample_rate_kHz until all speeds have as many");
}

std::optional<int> steps_beyond(const TimeDiscretisation& time, double from, double to, int steps,
                                const OrbitBranch& branch) {
  const BranchSettings own = segment_speeds(time, from, to, steps);
  const bool up = branch.reached_limit > 0;
  if (up ? own.high >= to : own.low <= from) return std::nullopt;
  return up ? steps / 2 : steps * 2;
}

void note_most_segments(OrbitBranch& branch) {
  branch.end += text("; of other steps per mesh period or in other candidate zones it was followed ",
                     kMostSegments, " times, the most");
}

namespace {

BranchSettings branch_settings(const SweepParameters& stage_settings, int steps, bool at_folds,
                               double tolerance) {
  BranchSettings settings =
      segment_speeds(stage_settings.time, stage_settings.frequency_from, stage_settings.frequency_to, steps);
  settings.first_step = 0.02;
  settings.largest_step = at_folds ? 0.25 : 0.06;
  settings.straight = at_folds ? 0.95 : 0.99;
  settings.location = 1e-6;
  settings.fold_location = at_folds ? 1e-5 : 1e-8;
  settings.grazing_location = at_folds ? 1 : 0.05;
  settings.orbit.tolerance = tolerance;
  return settings;
}

}  // namespace

BranchFollower::BranchFollower(RollingDynamics& dynamics, const GearMeshModel& model,
                               const StaticResult& statics, const SweepParameters& settings, Look look,
                               double tolerance)
    : dynamics_(dynamics),
      model_(model),
      statics_(statics),
      settings_(settings),
      look_(look),
      tolerance_(tolerance),
      finest_(steps_at(settings.time, settings.frequency_from)) {}

std::vector<BranchSegment> BranchFollower::follow(const Report& report) {
  const double high = settings_.frequency_to;
  const int steps = steps_at(settings_.time, high);
  begin(high, steps);
  std::vector<BranchSegment> segments;
  run(steps, -1, 0, report, segments);
  return segments;
}

std::vector<BranchSegment> BranchFollower::follow_from_sweep(Direction direction, double at,
                                                             const Report& report) {
  if (!(at >= settings_.frequency_from && at <= settings_.frequency_to))
    fail(Failure::input, "a branch cannot begin at ", at, " Hz: mesh_frequency_Hz is from ",
         settings_.frequency_from, " to ", settings_.frequency_to, " Hz");
  begin_swept(direction, at);
  const int steps = map_->steps();
  const VectorXd start = orbit_.start;
  const RollingDynamics::State state = map_->state(start);
  std::vector<BranchSegment> segments;
  run(steps, -1, 0, report, segments);
  if (closed_) return segments;
  resume(state, start, at, steps, true);
  run(steps, 1, 1, report, segments);
  return segments;
}

// From the orbit at hand, from segment to segment.
void BranchFollower::run(int steps, int direction, int part, const Report& report,
                         std::vector<BranchSegment>& segments) {
  const double low = settings_.frequency_from, high = settings_.frequency_to, scale = 0.5 * (low + high);
  const long total = std::max(1l, std::lround((high - low) / settings_.frequency_step));
  const VectorXd first = orbit_.start;
  const double first_at = orbit_.parameter;
  const size_t before = segments.size();
  double lowest = high;
  long gone = 0;  // steps
  closed_ = false;
  for (;;) {
    BranchSettings settings = branch_settings(settings_, steps, look_ == Look::at_folds, tolerance_);
    settings.multiple = multiple_;
    settings.stop = [&](const BranchPosition& last, const BranchPosition& next) -> std::string {
      // In its first step a part stands on the orbit that it began with.
      closed_ = gone++ > 0 && passes(last, next, first, first_at, scale);
      if (closed_) return "the branch closes on itself";
      if (multiple_ % 2 == 0 && becomes_half(last, next))
        return text("orbits of ", multiple_, " mesh periods become orbits of ", multiple_ / 2);
      return "";
    };
    segments.push_back({follow_branch(*map_, orbit_, direction, settings,
                                      [&](const BranchPosition& p) {
                                        map_->take_left_zone();  // beside the orbit
                                        lowest = std::min(lowest, p.parameter);
                                        report(std::lround((high - lowest) / (high - low) * total), total,
                                               text(p.parameter, " Hz"));
                                      }),
                        steps, multiple_, part});
    const OrbitBranch& branch = segments.back().branch;
    for (const SpecialPoint& p : branch.special)
      segments.back().special_state.push_back(map_->state(p.start));
    const BranchPosition& last = branch.points.back();
    const double at = last.parameter;
    direction = branch.reached_limit != 0 ? branch.reached_limit : last.turn > 0 ? 1 : -1;
    if (branch.stopped) return;
    if (segments.size() - before == kMostSegments) return note_most_segments(segments.back().branch);
    const RollingDynamics::State state = map_->state(last.start);  // while the zone is the map's own
    if (branch.reached_limit == 0) {
      if (!map_->take_left_zone()) return;
      widen();
    } else {
      const auto beyond = steps_beyond(settings_.time, low, high, steps, branch);
      if (!beyond) return;
      steps = *beyond;
    }
    try {
      resume(state, last.start, at, steps, branch.reached_limit == 0);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical || branch.reached_limit == 0) throw;
      note_steps_change(segments.back().branch, error.what());
      return;
    }
  }
}

void BranchFollower::follow_flips(std::vector<BranchSegment>& segments, int most, const Report& report) {
  // Segments that are added have flips of their own.
  for (size_t i = 0; i < segments.size(); ++i) {
    if (2 * segments[i].multiple > most) continue;
    const BranchSegment from = segments[i];
    for (size_t k = 0; k < from.branch.special.size(); ++k)
      if (from.branch.special[k].kind == Special::flip) follow_flip(from, k, report, segments);
  }
}

void BranchFollower::follow_flip(const BranchSegment& from, size_t which, const Report& report,
                                 std::vector<BranchSegment>& segments) {
  const SpecialPoint& flip = from.branch.special[which];
  const int part = segments.back().part + 1;
  const auto none = [&](const std::string& why) {
    BranchSegment empty{{}, from.steps, 2 * from.multiple, part};
    empty.branch.end = text("at the period doubling at ", flip.parameter, " Hz: ", why);
    segments.push_back(empty);
  };
  multiple_ = from.multiple;
  try {
    resume(from.special_state[which], flip.start, flip.parameter, from.steps, true);
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    return none(error.what());
  }
  SpecialPoint here = flip;
  here.start = orbit_.start;
  const double scale = 0.5 * (settings_.frequency_from + settings_.frequency_to);
  const OrbitSearch beside = orbit_beyond_flip(*map_, here, multiple_, scale);
  if (!beside.found()) return none(beside.failure);
  // A branch between two flips has been followed from the other one; its last point is a step beyond its end.
  for (const BranchSegment& known : segments)
    if (known.multiple == 2 * multiple_ && known.branch.stopped && !known.branch.points.empty() &&
        std::abs(known.branch.points.back().parameter - flip.parameter) < 2e-3 * flip.parameter)
      return none("the branch from another period doubling ends here");
  multiple_ *= 2;
  orbit_ = beside.orbit;
  run(from.steps, orbit_.parameter < flip.parameter ? -1 : 1, part, report, segments);
}

void BranchFollower::widen() {
  if (++level_ > kMostZoneLevel)
    fail_outside_range(Failure::numerical, "contact leaves the flanks: forces above ",
                       MotionBounds(model_, statics_, std::pow(kWidening, kMostZoneLevel)).force,
                       " N; lower the torque");
  dynamics_.set_zone(zone_of_level(model_, statics_, level_), finest_);
}

void BranchFollower::new_map(int steps) {
  map_ = std::make_unique<RollingPeriodMap>(dynamics_, steps);
  map_->measure(measure_);
}

// The orbit into which the pair settles.
void BranchFollower::begin(double at, int steps) {
  for (level_ = -1; !map_;) {
    widen();
    new_map(steps);
    map_->set_parameter(at);
    RollingDynamics::State state = dynamics_.rest();
    const auto periodic =
        iterate_to_orbit(dynamics_, state, settings_.time.periodicity, SteadyState::extrapolate);
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

// The motion of a sweep, speed by speed.
void BranchFollower::begin_swept(Direction direction, double at) {
  widen();
  RollingDynamics::State state = dynamics_.rest();
  const double sign = direction == Direction::up ? 1 : -1;
  double speed = direction == Direction::up ? settings_.frequency_from : settings_.frequency_to;
  for (;; speed += sign * settings_.frequency_step) {
    if (sign * (speed - at) > 0) speed = at;
    const RollingDynamics::State start = state;
    std::optional<Orbit> orbit;
    for (;;) {
      dynamics_.set_speed(speed, steps_at(settings_.time, speed));
      orbit = iterate_to_orbit(dynamics_, state, settings_.time.periodicity, settings_.time.steady_state);
      if (orbit) break;
      widen();
      state = start;
    }
    if (speed != at) continue;
    if (orbit->multiple == 0)
      fail(Failure::numerical, "at ", at, " Hz the motion of the sweep does not repeat within ",
           orbit->periods, " mesh periods; begin the branch at another speed");
    multiple_ = orbit->multiple;
    break;
  }
  const int steps = steps_at(settings_.time, at);
  new_map(steps);
  map_->set_parameter(at);
  const VectorXd start = map_->flat(state);
  if (!found(start, at, steps)) {
    widen();
    resume(state, start, at, steps, true);
  }
}

// With other steps or another zone: the orbit near that of before.
void BranchFollower::resume(const RollingDynamics::State& state, const VectorXd& start, double at, int steps,
                            bool wider) {
  for (;;) {
    new_map(steps);
    map_->set_parameter(at);
    RollingDynamics::State near = state;
    RollingDynamics::Period period;
    // An orbit puts the contact forces where this zone has its strips.
    int passed = 0;
    while (passed < multiple_ && dynamics_.integrate(near, period)) ++passed;
    if (passed == multiple_ && found(map_->flat(near), at, steps)) break;
    widen();
    wider = true;
  }
  // In another zone the contact forces stand elsewhere.
  if (!wider) mismatch_.push_back((orbit_.start - start).norm() / start.norm());
}

// Newton's method; false where contact leaves the zone.
bool BranchFollower::found(const VectorXd& start, double at, int steps) {
  OrbitSettings settings;
  settings.tolerance = tolerance_;
  const OrbitSearch search = newton_orbit(*map_, start, multiple_, settings);
  if (search.found()) {
    orbit_ = search.orbit;
    return true;
  }
  if (map_->take_left_zone()) return false;
  fail(Failure::numerical, "at ", at, " Hz no orbit of ", steps,
       " steps is found from that at hand: ", search.failure);
}

}  // namespace whine
