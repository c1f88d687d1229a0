#include "studies/fold_curves.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/strips_motion.h"
#include "gear/pair.h"
#include "orbits/fold_curve.h"
#include "signal/branches.h"
#include "studies/branch_follower.h"
#include "studies/harris_map.h"
#include "studies/jump_map.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int kWiderZones = 1;  // than the branch needed, for folds with larger motions

// The pair with one value of the quantity.
struct PairAt {
  PairAt(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& at_rest,
         const DynamicParameters& parameters, int positions)
      : statics(at_rest), motion(driver, driven, statics, parameters, positions) {}
  StaticResult statics;
  StripsMotion motion;
};

class Family {
 public:
  Family(const ReducedBody& driver, const ReducedBody& driven, const StaticParameters& statics, double torque,
         const SweepParameters& settings, const FoldCurvesPlan& plan)
      : driver_(driver),
        driven_(driven),
        parameters_(statics),
        torque_(torque),
        settings_(settings),
        plan_(plan),
        bearing_stiffness_(
            static_transmission(driver, driven, statics, settings.reference_torque).mean_stiffness) {
    own(plan.first);
    ImpactParameters fixed = settings;
    fixed.fidelity.contact = ContactModel::strips;
    fixed.damping.rayleigh_stiffness = 0;
    for (FixedPhaseState& state :
         fixed_phase_states(driver, driven, own_statics_, bearing_stiffness_, fixed, kStatePhases))
      if (state.contact_state == ContactState::two)
        two_ = std::make_unique<FixedPhaseState>(std::move(state));
    if (!two_)
      fail(Failure::input, "at ", torque,
           " N m no mesh phase has two pairs in contact, to which the damping ratio belongs");
  }

  // s, N m or m of a value of the plan.
  double raw(double value) const {
    return plan_.quantity == FoldQuantity::damping
               ? rayleigh_stiffness_for(value, two_->mesh, settings_.fidelity.body, two_->undamped_frequency)
               : value;
  }
  double damping_ratio(double raw) const {
    const double eta = plan_.quantity == FoldQuantity::damping ? raw : settings_.damping.rayleigh_stiffness;
    return frozen_root(with_rayleigh_stiffness(two_->mesh, eta, settings_.fidelity.body)).damping_ratio;
  }
  double bearing_stiffness() const { return bearing_stiffness_; }
  const StaticResult& statics() const { return own_statics_; }
  // The pair at a raw value.
  std::unique_ptr<PairAt> at(double raw) {
    own(raw);
    DynamicParameters p = dynamic_parameters(own_statics_, bearing_stiffness_, settings_, 0);
    if (plan_.quantity == FoldQuantity::damping) p.damping.rayleigh_stiffness = raw;
    require_relaxation_range(p.damping, p.fidelity.body, plan_.to);
    return std::make_unique<PairAt>(driver_, driven_, own_statics_, p, steps_at(settings_.time, plan_.from));
  }
  // For motions near a speed, with a zone of a level that holds them.
  std::unique_ptr<MotionMap> map(double raw, double speed, int level) {
    if (!current_ || raw != current_raw_) {
      current_ = at(raw);
      current_raw_ = raw;
      current_->motion.restore(level);
    }
    return current_->motion.map(steps(speed));
  }
  // A state of another zone in coordinates of that map: a period puts the contact forces where this zone has its strips.
  VectorXd moved(double raw, double speed, int level, MotionState state) {
    const auto map = this->map(raw, speed, level);
    map->set_parameter(speed);
    if (!current_->motion.fit(state, 1))
      fail_outside_range(Failure::numerical, "at ", speed,
                         " Hz contact leaves a zone wider than the branch needs");
    return map->flat_of(state);
  }
  int steps(double speed) const {  // per period
    return std::min(steps_at(settings_.time, speed), steps_at(settings_.time, plan_.from));
  }

 private:
  // Statics with the torque or the relief of a raw value.
  void own(double raw) {
    if (own_known_ && (plan_.quantity == FoldQuantity::damping || raw == own_raw_)) return;
    double torque = torque_;
    StaticParameters p = parameters_;
    if (plan_.quantity == FoldQuantity::torque) torque = raw;
    if (plan_.quantity == FoldQuantity::tip_relief)
      for (FlankModification& flank : p.mesh.modification) {
        flank.tip = {};
        flank.tip.amount = raw;
        if (raw > 0) flank.tip.length = single_pair_relief_length(driver_, driven_, parameters_.mesh);
      }
    own_statics_ = static_transmission(driver_, driven_, p, torque);
    own_raw_ = raw;
    own_known_ = true;
  }

  const ReducedBody &driver_, &driven_;
  const StaticParameters& parameters_;
  double torque_;
  const SweepParameters& settings_;
  const FoldCurvesPlan& plan_;
  double bearing_stiffness_;
  std::unique_ptr<FixedPhaseState> two_;
  StaticResult own_statics_;
  double own_raw_ = 0, current_raw_ = 0;
  bool own_known_ = false;
  std::unique_ptr<PairAt> current_;
};

// Of a branch: neighbours between which it is unstable, in the order of the arc, as states of a zone of a level. `end` names a last
// fold without another.
std::vector<std::pair<Fold, Fold>> pairs_of(const std::vector<BranchSegment>& segments, double value,
                                            int level, Family& family, std::string& end) {
  std::vector<std::pair<Fold, Fold>> pairs;
  std::vector<Fold> open;
  for (const auto& segment : segments)
    for (size_t k = 0; k < segment.branch.special.size(); ++k)
      if (const SpecialPoint& p = segment.branch.special[k]; p.kind == Special::fold) {
        Fold fold;
        fold.value = value;
        fold.parameter = p.parameter;
        fold.start = family.moved(value, p.parameter, level, segment.special_state[k]);
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
      rows.ratio.push_back(family.damping_ratio(fold.value));
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
    rows.cusp_ratio.push_back(family.damping_ratio(pair->cusp_value));
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

}  // namespace

FoldCurvesResult fold_curves(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& statics, double torque,
                             const SweepParameters& stage_settings, const FoldCurvesPlan& given,
                             const std::function<void(long, long, const std::string&)>& report) {
  require_ascending(given);
  require_like_teeth(statics.mesh, driver.design, driven.design, "a fold curve");
  FoldCurvesPlan plan = given;
  SweepParameters settings = stage_settings;
  if (plan.quantity == FoldQuantity::torque) torque = plan.first;
  Family family(driver, driven, statics, torque, settings, plan);
  const GearPair kinematics(driver.design, driven.design, statics.mesh.centre_distance);
  double inverse_mass = 0;  // kg-1
  for (int g = 0; g < kSides; ++g)
    inverse_mass += std::pow(kinematics.gear(g).base_radius(), 2) / settings.inertia[g];
  const VectorXd speeds =
      map_speeds({plan.from, plan.to, 50, 0},
                 std::sqrt(family.statics().mean_stiffness * inverse_mass) / (2 * std::numbers::pi));
  plan.from = settings.frequency_from = speeds[0];
  plan.to = settings.frequency_to = speeds[speeds.size() - 1];
  settings.frequency_step = 50;

  const double first = family.raw(plan.first);
  const std::unique_ptr<PairAt> pair = family.at(first);
  BranchFollower follower(pair->motion, speeds_of(settings), BranchFollower::Look::at_folds);
  const auto values = static_cast<long>(plan.values.size());
  const auto& segments = follower.follow(
      [&](long done, long total, const std::string& note) { report(done, total * (1 + 2 * values), note); });
  std::vector<double> above, below;
  for (const double value : plan.values) {
    if (value > plan.first) above.push_back(family.raw(value));
    if (value < plan.first) below.push_back(family.raw(value));
  }
  std::reverse(below.begin(), below.end());

  FoldCurveSettings fold_settings;
  fold_settings.parameter = {"mesh frequency", "Hz"};
  fold_settings.value = plan.quantity == FoldQuantity::damping  ? NamedParameter{"eta", "µs", 1e6}
                        : plan.quantity == FoldQuantity::torque ? NamedParameter{"torque", "N m"}
                                                                : NamedParameter{"tip relief", "µm", 1e6};
  fold_settings.scale = 0.5 * (plan.from + plan.to);
  fold_settings.low = plan.from;
  fold_settings.high = plan.to;
  fold_settings.tolerance = 1e-5;
  fold_settings.orbit.tolerance = 1e-8;
  fold_settings.one_map = [&](double one, double other) { return family.steps(one) == family.steps(other); };
  const int level = std::min(pair->motion.level() + kWiderZones, kMostZoneLevel);
  const MapFamily maps = [&](double raw, double speed) { return family.map(raw, speed, level); };
  Rows rows;
  int number = 0;
  long done = 0;
  for (const auto& of_branch : pairs_of(segments, first, level, family, rows.end)) {
    std::string failure;
    const auto own = own_folds(maps, first, of_branch, fold_settings, failure);
    if (!own) {
      rows.end += text(rows.end.empty() ? "" : "; ", failure);
      continue;
    }
    const auto followed = [&](const std::vector<double>& through) {
      return follow_folds(maps, own->first, own->second, through, fold_settings, [&](double raw) {
        report(std::min(++done, 2 * values), 2 * values,
               fold_settings.value.name + " " + fold_settings.value.words(raw));
      });
    };
    const FoldPair up = followed(above), down = followed(below);
    add_curves(up, down, family, number, rows);
    number += 2;
  }

  FoldCurvesResult a;
  GearPairParameters rest;  // without what the curve varies
  set_pair(rest, {driver, driven}, statics);
  set_motion(a, rest.gear, rest, settings);
  a.time = settings.time;
  if (plan.quantity == FoldQuantity::damping) a.damping.rayleigh_stiffness = 0;
  a.torque = torque;
  a.quantity = plan.quantity;
  a.first_value = first;
  fill(rows, a);
  return a;
}

}  // namespace whine
