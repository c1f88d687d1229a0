#include "studies/fold_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/model_range.h"
#include "base/units.h"
#include "dynamics/lines_motion.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "signal/branches.h"
#include "studies/harris_map.h"
#include "studies/jump_map.h"
#include "studies/pair_in_motion.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

namespace {

constexpr int kWiderZones = 1;  // than the branch needed, for folds with larger motions
constexpr const char* kNoBearing =
    "bearing_stiffness varies elastic bearings, and the scene has none; give one its stiffness_N_um";

// A pair on strips, or on lines, in one slice.
class PairScene : public FoldScene {
 public:
  PairScene(const ReducedBody& driver, const ReducedBody& driven, const StaticParameters& statics,
            double torque, const SweepParameters& settings, FoldCurvesPlan& plan)
      : driver_(driver),
        driven_(driven),
        parameters_(statics),
        torque_(torque),
        settings_(settings),
        quantity_(plan.quantity),
        mean_stiffness_(
            static_transmission(driver, driven, statics, settings.reference_torque).mean_stiffness) {
    if (quantity_ == FoldQuantity::bearing_stiffness && !statics.mesh.on_bearings())
      fail(Failure::input, kNoBearing);
    own(plan.first);
    SweepParameters fixed = settings;
    fixed.fidelity.contact = ContactModel::strips;
    fixed.damping.rayleigh_stiffness = 0;
    for (FixedPhaseState& state :
         fixed_phase_states(driver, driven, rest_, mean_stiffness_, fixed, kStatePhases))
      if (state.contact_state == ContactState::two)
        two_ = std::make_unique<FixedPhaseState>(std::move(state));
    if (!two_)
      fail(Failure::input, "at ", torque,
           " N m no mesh phase has two pairs in contact, to which the damping ratio belongs");
    const GearPair kinematics(driver.design, driven.design, statics.mesh.centre_distance);
    double inverse_mass = 0;  // kg-1
    for (int g = 0; g < kSides; ++g)
      inverse_mass += std::pow(kinematics.gear(g).base_radius(), 2) / settings.inertia[g];
    const Eigen::VectorXd speeds = map_speeds(
        {plan.from, plan.to, 50, 0}, std::sqrt(rest_.mean_stiffness * inverse_mass) / (2 * std::numbers::pi));
    plan.from = settings_.frequency_from = speeds[0];
    plan.to = settings_.frequency_to = speeds[speeds.size() - 1];
  }

  double raw(double value) const override {
    return quantity_ == FoldQuantity::damping
               ? rayleigh_stiffness_for(value, two_->mesh, settings_.fidelity.body, two_->undamped_frequency)
               : value;
  }
  double damping_ratio(double raw) const override {
    const double eta = quantity_ == FoldQuantity::damping ? raw : settings_.damping.rayleigh_stiffness;
    return frozen_root(with_rayleigh_stiffness(two_->mesh, eta, settings_.fidelity.body)).damping_ratio;
  }
  std::unique_ptr<MotionAt> at(double raw) override {
    own(raw);
    if (quantity_ == FoldQuantity::damping) settings_.damping.rayleigh_stiffness = raw;
    auto out = std::make_unique<MotionAt>();
    out->rest = rest_;
    out->motion = std::move(PairInMotion(driver_, driven_, out->rest, mean_stiffness_, settings_).motion);
    while (out->motion->level() < level_) out->motion->widen({});
    return out;
  }
  void hold(const Motion& of_branch) override {
    level_ = std::min(of_branch.level() + kWiderZones, of_branch.most_level());
  }

 private:
  // Statics of a raw value, unless it is a damping.
  void own(double raw) {
    if (known_ && (quantity_ == FoldQuantity::damping || raw == raw_)) return;
    double torque = torque_;
    StaticParameters p = parameters_;
    if (quantity_ == FoldQuantity::torque) torque = raw;
    if (quantity_ == FoldQuantity::tip_relief)
      for (FlankModification& flank : p.mesh.modification) {
        flank.tip = {};
        flank.tip.amount = raw;
        if (raw > 0) flank.tip.length = single_pair_relief_length(driver_, driven_, parameters_.mesh);
      }
    if (quantity_ == FoldQuantity::bearing_stiffness)
      for (Bearing& bearing : p.mesh.bearing) bearing.stiffness *= raw;
    rest_ = static_transmission(driver_, driven_, p, torque);
    raw_ = raw;
    known_ = true;
  }

  const ReducedBody &driver_, &driven_;
  const StaticParameters& parameters_;
  double torque_;
  SweepParameters settings_;
  FoldQuantity quantity_;
  double mean_stiffness_;  // N m-1
  std::unique_ptr<FixedPhaseState> two_;
  StaticResult rest_;
  double raw_ = 0;
  int level_ = 0;
  bool known_ = false;
};

// A train, or a pair in slices as a train of one mesh.
class TrainScene : public FoldScene {
 public:
  TrainScene(SystemSweepParameters settings, std::vector<ReducedBody> bodies, FoldCurvesPlan& plan)
      : settings_(std::move(settings)), bodies_(std::move(bodies)), quantity_(plan.quantity) {
    if (plan.from > 0) settings_.frequency_from = plan.from;
    if (plan.to > 0) settings_.frequency_to = plan.to;
    plan.from = settings_.frequency_from;
    plan.to = settings_.frequency_to;
    const System& layout = settings_.layout;
    input_ = input_of(layout);
    if (quantity_ == FoldQuantity::tip_relief)
      fail(Failure::input, "tip_relief varies pairs in one slice over the face alone; of this scene ",
           "damping, torque and bearing_stiffness may vary");
    if (quantity_ == FoldQuantity::torque && !(torque() > 0))
      fail(Failure::input, "torque varies the torque that drives a train, and no drive gives power");
    if (quantity_ == FoldQuantity::bearing_stiffness &&
        std::none_of(layout.bodies.begin(), layout.bodies.end(),
                     [](const System::Body& body) { return body.bearing.elastic(); }))
      fail(Failure::input, kNoBearing);
    const std::unique_ptr<LinesMotion> motion = moving(settings_);
    source_ = motion->source();
    frequency_ = motion->natural_frequency();
    hold(*motion);
    if (quantity_ != FoldQuantity::damping)
      for (const double value : {plan.first, plan.values.front(), plan.values.back()})
        reach_ = std::max(reach_, moving(settings_at(value))->reach());
  }
  const MotionSource& source() const { return source_; }

  double raw(double value) const override {
    if (quantity_ != FoldQuantity::damping) return value;
    Damping mass = settings_.damping;
    mass.rayleigh_stiffness = 0;
    const double other = rayleigh_ratio(mass, frequency_);
    if (!(value > other))
      fail(Failure::input, "a damping ratio of ", value, " is not above ", other,
           ", which rayleigh_mass_per_s alone gives at ", frequency_, " Hz");
    return 2 * (value - other) / (kTwoPi * frequency_);
  }
  double damping_ratio(double raw) const override {
    Damping damping = settings_.damping;
    if (quantity_ == FoldQuantity::damping) damping.rayleigh_stiffness = raw;
    return rayleigh_ratio(damping, frequency_);
  }
  std::unique_ptr<MotionAt> at(double raw) override {
    auto out = std::make_unique<MotionAt>();
    out->motion = moving(settings_at(raw));
    while (out->motion->reach() < reach_) out->motion->widen({});
    return out;
  }
  // States are of these tooth pairs, at every value: tip edges are looked for until they are as many.
  void hold(const Motion& of_branch) override { reach_ = std::max(reach_, of_branch.reach()); }

 private:
  SystemSweepParameters settings_at(double raw) const {
    SystemSweepParameters own = settings_;
    if (quantity_ == FoldQuantity::damping) own.damping.rayleigh_stiffness = raw;
    if (quantity_ == FoldQuantity::torque)
      for (System::Drive& drive : own.layout.drives) drive.torque *= raw / torque();
    if (quantity_ == FoldQuantity::bearing_stiffness)
      for (System::Body& body : own.layout.bodies) body.bearing.stiffness *= raw;
    return own;
  }
  double torque() const { return settings_.layout.torque(input_); }  // N m
  std::unique_ptr<LinesMotion> moving(const SystemSweepParameters& settings) const {
    require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
    return std::make_unique<LinesMotion>(settings, bodies_, steps_at(settings.time, settings.frequency_from));
  }

  SystemSweepParameters settings_;
  std::vector<ReducedBody> bodies_;
  FoldQuantity quantity_;
  int input_ = 0, reach_ = 0;  // body; as Motion::reach()
  MotionSource source_;
  double frequency_ = 0;  // Hz
};

}  // namespace

std::unique_ptr<FoldScene> fold_scene(const ReducedBody& driver, const ReducedBody& driven,
                                      const StaticParameters& statics, double torque,
                                      const SweepParameters& settings, FoldCurvesPlan& plan) {
  if (settings.fidelity.width == WidthModel::one)
    return std::make_unique<PairScene>(driver, driven, statics, torque, settings, plan);
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
  const double stiffness =
      static_transmission(driver, driven, statics, settings.reference_torque).mean_stiffness;
  const StaticResult rest = static_transmission(driver, driven, statics, torque);
  return std::make_unique<TrainScene>(train_of_slices(driver, driven, rest, stiffness, settings),
                                      std::vector<ReducedBody>{driver, driven}, plan);
}

std::unique_ptr<FoldScene> fold_scene(const SystemSweepParameters& settings,
                                      const std::vector<ReducedBody>& bodies, FoldCurvesPlan& plan,
                                      MotionSource& source) {
  auto out = std::make_unique<TrainScene>(settings, bodies, plan);
  source = out->source();
  return out;
}

}  // namespace whine
