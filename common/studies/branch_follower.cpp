#include "studies/branch_follower.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/format.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::VectorXd;

BranchSettings segment_speeds(const TimeDiscretisation& time, double from, double to, int steps) {
  BranchSettings settings;
  settings.low = from;
  settings.high = to;
  settings.scale = 0.5 * (settings.low + settings.high);
  settings.parameter = {"mesh frequency", "Hz"};
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

BranchSettings branch_settings(const MotionSettings& speeds, int steps, bool at_folds, double tolerance) {
  BranchSettings settings = segment_speeds(speeds.time, speeds.frequency_from, speeds.frequency_to, steps);
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

BranchFollower::BranchFollower(Motion& motion, const MotionSettings& speeds, Look look, double tolerance)
    : motion_(motion), speeds_(speeds), look_(look), tolerance_(tolerance) {}

auto BranchFollower::follow(const BranchPlan& plan, const Report& report) -> const std::vector<Segment>& {
  if (plan.most_periods != 1 && plan.most_periods != 2 && plan.most_periods != 4)
    fail(Failure::input, "orbits of ", plan.most_periods, " mesh periods are not followed; give 1, 2 or 4");
  if (!(plan.tolerance >= 1e-12 && plan.tolerance <= 1e-3))
    fail(Failure::input, "an orbit's tolerance of ", plan.tolerance, "; give 1e-12 to 1e-3");
  if (!(speeds_.frequency_from > 0) || !(speeds_.frequency_to > speeds_.frequency_from))
    fail(Failure::input, "a branch needs speeds to go through: mesh_frequency_Hz is from ",
         speeds_.frequency_from, " to ", speeds_.frequency_to, " Hz");
  tolerance_ = plan.tolerance;
  plan.sweep ? follow_from_sweep(*plan.sweep, plan.at, report) : follow(report);
  follow_flips(plan.most_periods, report);
  return segments_;
}

auto BranchFollower::follow(const Report& report) -> const std::vector<Segment>& {
  const int steps = steps_at(speeds_.time, speeds_.frequency_to);
  begin(speeds_.frequency_to, steps);
  run(steps, -1, 0, report);
  return segments_;
}

auto BranchFollower::follow_from_sweep(Direction direction, double at, const Report& report)
    -> const std::vector<Segment>& {
  if (!(at >= speeds_.frequency_from && at <= speeds_.frequency_to))
    fail(Failure::input, "a branch cannot begin at ", at, " Hz: mesh_frequency_Hz is from ",
         speeds_.frequency_from, " to ", speeds_.frequency_to, " Hz");
  begin_swept(direction, at);
  const int steps = map_->steps();
  const VectorXd start = orbit_.start;
  kept_ = map_->state_of(start);
  run(steps, -1, 0, report);
  if (closed_) return segments_;
  resume(*kept_, start, at, steps, true);
  run(steps, 1, 1, report);
  return segments_;
}

// From the orbit at hand, from segment to segment.
void BranchFollower::run(int steps, int direction, int part, const Report& report) {
  const double low = speeds_.frequency_from, high = speeds_.frequency_to, scale = 0.5 * (low + high);
  const long total = std::max(1l, std::lround((high - low) / speeds_.frequency_step));
  const VectorXd first = orbit_.start;
  const double first_at = orbit_.parameter;
  const size_t before = segments_.size();
  double lowest = high;
  long gone = 0;  // steps
  closed_ = false;
  for (;;) {
    BranchSettings settings = branch_settings(speeds_, steps, look_ == Look::at_folds, tolerance_);
    settings.multiple = multiple_;
    settings.stop = [&](const BranchPosition& last, const BranchPosition& next) -> std::string {
      // In its first step a part stands on the orbit that it began with.
      closed_ = gone++ > 0 && passes(last, next, first, first_at, scale);
      if (closed_) return "the branch closes on itself";
      if (multiple_ % 2 == 0 && becomes_half(last, next))
        return text("orbits of ", multiple_, " mesh periods become orbits of ", multiple_ / 2);
      return "";
    };
    segments_.push_back({follow_branch(*map_, orbit_, direction, settings,
                                       [&](const BranchPosition& p) {
                                         map_->take_left_zone();  // beside the orbit
                                         lowest = std::min(lowest, p.parameter);
                                         report(std::lround((high - lowest) / (high - low) * total), total,
                                                text(p.parameter, " Hz"));
                                       }),
                         steps, multiple_, part});
    const OrbitBranch& branch = segments_.back().branch;
    for (const SpecialPoint& p : branch.special) {
      segments_.back().special_state.push_back(map_->state_of(p.start));
      segments_.back().special_place.push_back(map_->place_of(p.event.contact));
    }
    const BranchPosition& last = branch.points.back();
    const double at = last.parameter;
    direction = branch.reached_limit != 0 ? branch.reached_limit : last.turn > 0 ? 1 : -1;
    if (branch.stopped) return;
    if (segments_.size() - before == kMostSegments) return note_most_segments(segments_.back().branch);
    State state = map_->state_of(last.start);  // while the contacts are the map's own
    if (branch.reached_limit == 0) {
      if (!map_->take_left_zone()) return;
      widen(state);
    } else {
      const auto beyond = steps_beyond(speeds_.time, low, high, steps, branch);
      if (!beyond) return;
      steps = *beyond;
    }
    try {
      resume(state, last.start, at, steps, branch.reached_limit == 0);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical || branch.reached_limit == 0) throw;
      note_steps_change(segments_.back().branch, error.what());
      return;
    }
  }
}

void BranchFollower::follow_flips(int most, const Report& report) {
  // Segments that are added have flips of their own.
  for (size_t i = 0; i < segments_.size(); ++i) {
    if (2 * segments_[i].multiple > most) continue;
    for (size_t k = 0; k < segments_[i].branch.special.size(); ++k)
      if (segments_[i].branch.special[k].kind == Special::flip) follow_flip(i, k, report);
  }
}

void BranchFollower::follow_flip(size_t of, size_t which, const Report& report) {
  const Segment from = segments_[of];
  const SpecialPoint& flip = from.branch.special[which];
  const int part = segments_.back().part + 1;
  const auto none = [&](const std::string& why) {
    Segment empty{{}, from.steps, 2 * from.multiple, part};
    empty.branch.end = text("at the period doubling at ", shown_number(flip.parameter), " Hz: ", why);
    segments_.push_back(empty);
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
  const double scale = 0.5 * (speeds_.frequency_from + speeds_.frequency_to);
  const OrbitSearch beside = orbit_beyond_flip(*map_, here, multiple_, scale);
  if (!beside.found()) return none(beside.failure);
  // A branch between two flips has been followed from the other one; its last point is a step beyond its end.
  for (const Segment& known : segments_)
    if (known.multiple == 2 * multiple_ && known.branch.stopped && !known.branch.points.empty() &&
        std::abs(known.branch.points.back().parameter - flip.parameter) < 2e-3 * flip.parameter)
      return none("the branch from another period doubling ends here");
  multiple_ *= 2;
  orbit_ = beside.orbit;
  run(from.steps, orbit_.parameter < flip.parameter ? -1 : 1, part, report);
}

// The next set of candidate contacts, which all states that are kept fit then.
void BranchFollower::widen(State& state) {
  std::vector<State*> all{&state};
  if (kept_) all.push_back(&*kept_);
  for (Segment& segment : segments_)
    for (State& special : segment.special_state) all.push_back(&special);
  motion_.widen(all);
}

void BranchFollower::new_map(double at, int steps) {
  map_ = motion_.map(steps);
  map_->measure(measure_);
  map_->set_parameter(at);
}

std::optional<MotionRecord> BranchFollower::settle(State& state, double at, int steps, SteadyState method) {
  return motion_.settle(state, at, steps, {speeds_.time.periodicity, method, {}, false});
}

// The orbit into which the motion settles.
void BranchFollower::begin(double at, int steps) {
  motion_.restore(0);
  for (;;) {
    new_map(at, steps);
    State state = motion_.rest();
    const auto settled = settle(state, at, steps, SteadyState::extrapolate);
    if (settled) {
      if (settled->multiple != 1)
        fail(Failure::numerical, "at ", at, " Hz, where the branch begins, the motion ",
             settled->multiple == 0 ? text("does not repeat within ", settled->periods, " mesh periods")
                                    : text("repeats after ", settled->multiple, " mesh periods"),
             "; give mesh_frequency_Hz another upper end");
      if (found(map_->flat_of(state), at, steps)) return;
    }
    widen(state);
  }
}

// The motion of a sweep, speed by speed.
void BranchFollower::begin_swept(Direction direction, double at) {
  motion_.restore(0);
  State state = motion_.rest();
  const double sign = direction == Direction::up ? 1 : -1;
  double speed = direction == Direction::up ? speeds_.frequency_from : speeds_.frequency_to;
  for (;; speed += sign * speeds_.frequency_step) {
    if (sign * (speed - at) > 0) speed = at;
    State start = state;
    std::optional<MotionRecord> settled;
    while (!(settled = settle(state, speed, steps_at(speeds_.time, speed), speeds_.time.steady_state))) {
      widen(start);
      state = start;
    }
    if (speed != at) continue;
    if (settled->multiple == 0)
      fail(Failure::numerical, "at ", at, " Hz the motion of the sweep does not repeat within ",
           settled->periods, " mesh periods; begin the branch at another speed");
    multiple_ = settled->multiple;
    break;
  }
  const int steps = steps_at(speeds_.time, at);
  new_map(at, steps);
  const VectorXd start = map_->flat_of(state);
  if (!found(start, at, steps)) {
    widen(state);
    resume(state, start, at, steps, true);
  }
}

// With other steps or other candidate contacts: the orbit near that of before.
void BranchFollower::resume(State state, const VectorXd& start, double at, int steps, bool wider) {
  for (;;) {
    new_map(at, steps);
    State near = state;
    if (motion_.fit(near, multiple_) && found(map_->flat_of(near), at, steps)) break;
    widen(state);
    wider = true;
  }
  // With other contacts the forces stand elsewhere.
  if (!wider && orbit_.start.size() == start.size())
    mismatch_.push_back((orbit_.start - start).norm() / start.norm());
}

// Newton's method; false where contact leaves the candidates.
bool BranchFollower::found(const VectorXd& start, double at, int steps) {
  OrbitSettings settings;
  settings.tolerance = tolerance_;
  const OrbitSearch search = newton_orbit(*map_, start, multiple_, settings);
  if (search.found()) {
    map_->take_left_zone();
    orbit_ = search.orbit;
    return true;
  }
  if (map_->take_left_zone()) return false;
  fail(Failure::numerical, "at ", at, " Hz no orbit of ", steps,
       " steps is found from that at hand: ", search.failure);
}

std::string ends_of(const std::vector<BranchSegment>& segments) {
  std::string words;
  for (size_t k = 0; k < segments.size(); ++k)
    if (k + 1 == segments.size() || segments[k + 1].part != segments[k].part)
      words += (words.empty() ? "" : "; ") + segments[k].branch.end;
  return words;
}

}  // namespace whine
