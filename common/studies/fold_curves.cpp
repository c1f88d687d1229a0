#include "studies/fold_curves.h"

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/lines_motion.h"
#include "gear/train.h"
#include "orbits/fold_curve.h"
#include "studies/branch_follower.h"
#include "studies/fold_scene.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// The maps of a scene.
class Family {
 public:
  // The scene must live as long as this.
  Family(FoldScene& scene, const TimeDiscretisation& time, double from)
      : scene_(scene), time_(time), from_(from) {}

  FoldScene& scene() { return scene_; }
  // For motions near a speed.
  std::unique_ptr<MotionMap> map(double raw, double speed) {
    if (!current_ || raw != current_raw_) {
      current_ = scene_.at(raw);
      current_raw_ = raw;
    }
    return current_->motion->map(steps(speed));
  }
  // A state of other candidates in coordinates of that map: a period puts the contact forces where these have their strips.
  VectorXd moved(double raw, double speed, MotionState state) {
    const auto map = this->map(raw, speed);
    map->set_parameter(speed);
    if (!current_->motion->fit(state, 1))
      fail_outside_range(Failure::numerical, "at ", speed,
                         " Hz contact leaves a zone wider than the branch needs");
    return map->flat_of(state);
  }
  int steps(double speed) const {  // per period
    return std::min(steps_at(time_, speed), steps_at(time_, from_));
  }

 private:
  FoldScene& scene_;
  const TimeDiscretisation time_;
  double from_, current_raw_ = 0;  // Hz
  std::unique_ptr<MotionAt> current_;
};

// Of a branch: neighbours between which it is unstable, in the order of the arc. `end` names a last
// fold without another.
std::vector<std::pair<Fold, Fold>> pairs_of(const std::vector<BranchSegment>& segments, double value,
                                            Family& family, std::string& end) {
  std::vector<std::pair<Fold, Fold>> pairs;
  std::vector<Fold> open;
  for (const auto& segment : segments)
    for (size_t k = 0; k < segment.branch.special.size(); ++k)
      if (const SpecialPoint& p = segment.branch.special[k]; p.kind == Special::fold) {
        Fold fold;
        fold.value = value;
        fold.parameter = p.parameter;
        fold.start = family.moved(value, p.parameter, segment.special_state[k]);
        open.push_back(fold);
        if (open.size() == 2) {
          pairs.emplace_back(open[0], open[1]);
          open.clear();
        }
      }
  if (!open.empty())
    end = text("the branch leaves the speeds beyond its fold at ", shown_number(open[0].parameter),
               " Hz, which is not followed; ", segments.back().branch.end);
  else if (pairs.empty())
    end = "the branch has no folds; " + segments.back().branch.end;
  return pairs;
}

struct Rows {
  std::vector<int> curve, highest, cusp_curve;
  std::vector<double> value, ratio, frequency, before, after, cusp_value, cusp_ratio, cusp_frequency;
  std::string end;
};

// Both directions of a curve as one, the values ascending.
void add_curves(const FoldPair& up, const FoldPair& down, Family& family, int number, Rows& rows) {
  for (int side = 0; side < 2; ++side) {
    std::vector<Fold> all(side == 0 ? down.low : down.high);
    std::reverse(all.begin(), all.end());
    all.pop_back();  // the first one is in both
    const auto& further = side == 0 ? up.low : up.high;
    all.insert(all.end(), further.begin(), further.end());
    for (const Fold& fold : all) {
      rows.curve.push_back(number + side);
      rows.highest.push_back(fold.bend < 0);
      rows.value.push_back(fold.value);
      rows.ratio.push_back(family.scene().damping_ratio(fold.value));
      rows.frequency.push_back(fold.parameter);
      rows.before.push_back(fold.before);
      rows.after.push_back(fold.after);
    }
  }
  for (const FoldPair* pair : {&up, &down}) {
    if (rows.end != pair->end) rows.end += text(rows.end.empty() ? "" : "; ", pair->end);
    if (!pair->cusp) continue;
    rows.cusp_curve.push_back(number);
    rows.cusp_value.push_back(pair->cusp_value);
    rows.cusp_ratio.push_back(family.scene().damping_ratio(pair->cusp_value));
    rows.cusp_frequency.push_back(pair->cusp_parameter);
  }
}

VectorXd vector(const std::vector<double>& from) {
  return Eigen::Map<const VectorXd>(from.data(), static_cast<Index>(from.size()));
}
Eigen::VectorXi vector(const std::vector<int>& from) {
  return Eigen::Map<const Eigen::VectorXi>(from.data(), static_cast<Index>(from.size()));
}

void require_ascending(const FoldCurvesPlan& plan) {
  if (plan.values.empty()) fail(Failure::input, "no value of ", plan.quantity, " to go through");
  for (size_t i = 0; i + 1 < plan.values.size(); ++i)
    if (!(plan.values[i] < plan.values[i + 1]))
      fail(Failure::input, "values of ", plan.quantity, " ascend: ", plan.values[i + 1], " follows ",
           plan.values[i]);
  if (!(plan.first > 0) && plan.quantity != FoldQuantity::tip_relief)
    fail(Failure::input, "the first value of ", plan.quantity, " is ", plan.first, "; it must be above 0");
}

// The two folds of a branch as those of the maps of a family, with their tangents and bends. Nothing, with the reason, if one is
// not found.
std::optional<std::pair<Fold, Fold>> own_folds(const MapFamily& maps, double value,
                                               const std::pair<Fold, Fold>& of_branch,
                                               const FoldCurveSettings& settings, std::string& failure) {
  const auto own = [&](const Fold& guess) {
    return find_turn(*maps(value, guess.parameter), guess, settings, failure);
  };
  auto one = own(of_branch.first), other = own(of_branch.second);
  if (!one || !other) return std::nullopt;
  return std::pair{std::move(*one), std::move(*other)};
}

NamedParameter named(FoldQuantity quantity) {
  switch (quantity) {
    case FoldQuantity::damping:
      return {"eta", "µs", 1e6};
    case FoldQuantity::torque:
      return {"torque", "N m"};
    case FoldQuantity::tip_relief:
      return {"tip relief", "µm", 1e6};
    case FoldQuantity::bearing_stiffness:
      return {"bearing stiffness over that of the scene", ""};
  }
  return {};
}

FoldCurveSettings settings_of(const Family& family, const FoldCurvesPlan& plan) {
  FoldCurveSettings out;
  out.parameter = {"mesh frequency", "Hz"};
  out.value = named(plan.quantity);
  out.scale = 0.5 * (plan.from + plan.to);
  out.low = plan.from;
  out.high = plan.to;
  out.tolerance = 1e-5;
  out.orbit.tolerance = 1e-8;
  out.one_map = [&family](double one, double other) { return family.steps(one) == family.steps(other); };
  return out;
}

void fill(const Rows& rows, FoldCurvesResult& a) {
  a.curve = vector(rows.curve);
  a.value = vector(rows.value);
  a.damping_ratio = vector(rows.ratio);
  a.fold_frequency = vector(rows.frequency);
  a.fold_multiplier.resize(a.value.size(), 2);
  a.fold_multiplier.col(0) = vector(rows.before);
  a.fold_multiplier.col(1) = vector(rows.after);
  a.highest = vector(rows.highest);
  a.cusp_value = vector(rows.cusp_value);
  a.cusp_damping_ratio = vector(rows.cusp_ratio);
  a.cusp_frequency = vector(rows.cusp_frequency);
  a.cusp_curve = vector(rows.cusp_curve);
  a.end = rows.end;
}

// Those of a scene into a result that says what it is of; plan: with its speeds.
void follow(FoldScene& scene, const TimeDiscretisation& time, const FoldCurvesPlan& plan,
            const FoldReport& report, FoldCurvesResult& a) {
  constexpr double kStep = 50;  // Hz, of what is reported
  Family family(scene, time, plan.from);
  const double first = scene.raw(plan.first);
  const std::unique_ptr<MotionAt> begin = scene.at(first);
  BranchFollower follower(*begin->motion, {{plan.from, plan.to, kStep}, {}, time},
                          BranchFollower::Look::at_folds);
  const auto values = static_cast<long>(plan.values.size());
  const auto& segments = follower.follow(
      [&](long done, long total, const std::string& note) { report(done, total * (1 + 2 * values), note); });
  std::vector<double> above, below;
  for (const double value : plan.values) {
    if (value > plan.first) above.push_back(scene.raw(value));
    if (value < plan.first) below.push_back(scene.raw(value));
  }
  std::reverse(below.begin(), below.end());

  const FoldCurveSettings settings = settings_of(family, plan);
  scene.hold(*begin->motion);
  const MapFamily maps = [&](double raw, double speed) { return family.map(raw, speed); };
  Rows rows;
  int number = 0;
  long done = 0;
  for (const auto& of_branch : pairs_of(segments, first, family, rows.end)) {
    std::string failure;
    const auto own = own_folds(maps, first, of_branch, settings, failure);
    if (!own) {
      rows.end += text(rows.end.empty() ? "" : "; ", failure);
      continue;
    }
    const auto followed = [&](const std::vector<double>& through) {
      return follow_folds(maps, own->first, own->second, through, settings, [&](double raw) {
        report(std::min(++done, 2 * values), 2 * values,
               settings.value.name + " " + settings.value.words(raw));
      });
    };
    const FoldPair up = followed(above), down = followed(below);
    add_curves(up, down, family, number, rows);
    number += 2;
  }
  a.quantity = plan.quantity;
  a.first_value = first;
  fill(rows, a);
}

}  // namespace

FoldCurvesResult fold_curves(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& statics, double torque, const SweepParameters& settings,
                             const FoldCurvesPlan& given, const FoldReport& report) {
  require_ascending(given);
  require_able("fold-curves", traits(statics.mesh, driver.design, driven.design));
  FoldCurvesPlan plan = given;
  if (plan.quantity == FoldQuantity::torque) torque = plan.first;
  const std::unique_ptr<FoldScene> scene = fold_scene(driver, driven, statics, torque, settings, plan);
  FoldCurvesResult a;
  GearPairParameters rest;  // without what the curve varies
  set_pair(rest, {driver, driven}, statics);
  set_motion(a, rest.gear, rest, settings);
  if (plan.quantity == FoldQuantity::damping) a.damping.rayleigh_stiffness = 0;
  a.torque = torque;
  a.place_pair(pair_system(a));
  follow(*scene, settings.time, plan, report, a);
  return a;
}

FoldCurvesResult fold_curves(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                             const FoldCurvesPlan& given, const FoldReport& report) {
  require_ascending(given);
  require_able("fold-curves", traits(settings, bodies));
  FoldCurvesPlan plan = given;
  FoldCurvesResult a;
  const std::unique_ptr<FoldScene> scene = fold_scene(settings, bodies, plan, a);
  if (plan.quantity == FoldQuantity::damping) a.damping.rayleigh_stiffness = 0;
  follow(*scene, settings.time, plan, report, a);
  return a;
}

}  // namespace whine
