#include "dynamics/lines_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/system_period_map.h"
#include "gear/layout.h"
#include "gear/system_layout.h"
#include "orbits/recurrence.h"
#include "signal/rms.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr int kRestPositions = 32;  // of the statics that come first, in each mesh period
constexpr int kMostRestPositions = 2048,
              kFewestRestPositions = 4;  // in all of a hunting period; in a mesh period
constexpr double kBeyondStatics = 2.5;   // deflection that tip edges are looked for, over that of rest

// m: norm over the meshes of what oscillates of their transmission errors.
double norm_of_rms(const std::vector<MotionPeriod>& record) {
  double squares = 0;
  for (Index m = 0; m < record[0].transmission_error.rows(); ++m) {
    std::vector<Eigen::VectorXd> rows;
    std::vector<Eigen::Ref<const Eigen::VectorXd>> parts;
    rows.reserve(record.size());
    parts.reserve(record.size());
    for (const MotionPeriod& period : record) rows.emplace_back(period.transmission_error.row(m).transpose());
    for (const Eigen::VectorXd& row : rows) parts.emplace_back(row);
    squares += std::pow(oscillating_rms(parts), 2);
  }
  return std::sqrt(squares);
}

SystemModel in_motion(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies) {
  require_able("motion", traits(settings.fidelity));
  return elastic_system(settings, bodies, settings.damping.undamped_depth);
}

}  // namespace

Traits traits(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies) {
  Traits out;
  for (size_t b = 0; b < settings.errors.size(); ++b)
    if (settings.has_errors(b)) out.emplace_back(Trait::differing, "[gear." + settings.gear[b] + ".error]");
  for (size_t g = 0; g < settings.body.size() && g < bodies.size(); ++g)
    if (bodies[g].design.crack.depth > 0)
      out.emplace_back(Trait::cracked, "[gear." + settings.body[g].first + ".crack]");
  return out;
}

LinesMotion::LinesMotion(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                         int positions)
    : system_(in_motion(settings, bodies)), settings_(settings), positions_(positions) {
  take_masses(settings, bodies, system_.layout);
  take_rest();
  // A mesh without load has a tenth of the deflection of the most loaded one.
  const double most = *std::max_element(deflection_.begin(), deflection_.end());
  for (double& deflection : deflection_) deflection = std::max(deflection, 0.1 * most);
  motion_.damping = settings.damping;
  motion_.fidelity = settings.fidelity;
  motion_.fidelity.contact = ContactModel::line;
  motion_.axis_frequency = axis_frequency(
      system_, settings.axis_stiffness > 0 ? MatrixXd::Constant(1, 1, settings.axis_stiffness) : stiffness_);
  motion_.frame_turns = frame_turns(system_.layout);
  dynamics_ = placed();
}

void LinesMotion::take_rest() {
  const auto meshes = static_cast<Index>(system_.mesh.size());
  stiffness_ = MatrixXd::Zero(meshes, meshes);
  deflection_.assign(system_.mesh.size(), 0);
  SystemModel still = system_;
  motion_.output = hold_output(still);
  const std::vector<SystemSolution> rest = rest_over_period(
      still, ContactModel::line, settings_.contact.strips,
      std::clamp(kMostRestPositions / whine::hunting_periods(system_), kFewestRestPositions, kRestPositions));
  for (const SystemSolution& at : rest) {
    stiffness_ += at.mesh_stiffness / static_cast<double>(rest.size());
    for (size_t m = 0; m < system_.mesh.size(); ++m)
      deflection_[m] = std::max(deflection_[m], at.deflection[m]);
  }
  take_losses(still, rest);
}

// Losses at rest over the coefficients there, on the body that gives what is left; those in motion go with the speed.
void LinesMotion::take_losses(const SystemModel& still, const std::vector<SystemSolution>& rest) {
  system_.friction.clear();
  if (motion_.output < 0) return;
  motion_.loss = Eigen::VectorXd::Zero(static_cast<Index>(still.mesh.size()));
  const double turned =
      2 * std::numbers::pi * ground_turns(system_.layout, motion_.output);  // in a mesh period
  for (const SystemSolution& at : rest)
    for (size_t m = 0; m < still.mesh.size(); ++m)
      if (still.friction[m] > 0)
        motion_.loss[static_cast<Index>(m)] +=
            at.friction_work[m] / still.friction[m] / turned / static_cast<double>(rest.size());
}

std::unique_ptr<SystemDynamics> LinesMotion::placed() const {
  std::vector<double> gap;
  gap.reserve(deflection_.size());
  for (const double deflection : deflection_)
    gap.push_back(kBeyondStatics * deflection * std::pow(kWidening, widenings_));
  auto dynamics = std::make_unique<SystemDynamics>(system_, motion_);
  dynamics->set_positions(gap, positions_);
  return dynamics;
}

void LinesMotion::widen(const std::vector<State*>& states) {
  if (widenings_ == kMostWidenings) {
    const auto worst =
        static_cast<size_t>(std::max_element(deflection_.begin(), deflection_.end()) - deflection_.begin());
    fail_outside_range(Failure::numerical, "the meshes deflect beyond the tip edges that are looked at, ",
                       kBeyondStatics * std::pow(kWidening, widenings_) * deflection_[worst] * 1e6,
                       " micrometres at ", mesh_name(system_.layout, worst),
                       "; lower the torque or raise the damping");
  }
  ++widenings_;
  std::unique_ptr<SystemDynamics> wider = placed();
  for (State* state : states) {
    auto& own = std::get<SystemDynamics::State>(*state);
    own = wider->fitted(own, *dynamics_);
  }
  dynamics_ = std::move(wider);
}

double LinesMotion::natural_frequency() {
  constexpr int kPhases = 16;
  const Eigen::VectorXd turning = dynamics_->coordinates().turning(input_of(system_.layout));
  double sum = 0;
  for (int i = 0; i < kPhases; ++i) {
    const SystemDynamics::FrozenModes modes = dynamics_->frozen_modes(i * positions_ / kPhases);
    Index softest = 0;
    (turning.transpose() * modes.shape)
        .transpose()
        .cwiseQuotient(modes.frequency)
        .cwiseAbs()
        .maxCoeff(&softest);
    sum += modes.frequency[softest] / kPhases;
  }
  return sum;
}

double LinesMotion::axis_damper(int g) {
  return 2 * settings_.damping.bearing_ratio * system_.layout.bodies[static_cast<size_t>(g)].inertia *
         motion_.axis_frequency;
}

std::optional<MotionRecord> LinesMotion::settle(State& state, double mesh_frequency, int steps,
                                                const Settling& how, MotionAcceleration* shared) {
  const int hunting = hunting_periods();
  auto& own = std::get<SystemDynamics::State>(state);
  SystemPeriodMap map(*dynamics_, steps);
  map.set_parameter(mesh_frequency);
  if (shared && shared->level != widenings_) {
    shared->forget();
    shared->level = widenings_;
  }
  MotionRecord out;
  try {
    const PeriodicMotion found =
        iterate_to_orbit(map, map.flat(own),
                         {how.periodicity, std::max(kMostSystemPeriods / hunting, kLeastSystemTurns),
                          how.method == SteadyState::extrapolate},
                         shared ? &shared->lines : nullptr);
    own = map.state(found.state);
    out.multiple = found.multiple * hunting;
    out.periods = found.turns * hunting;
    out.residual = found.residual;
  } catch (const ModelRangeError&) {
    // Of a proposal that was rejected before nothing is thrown: this is of the period integrated last.
    if (!map.left_last()) throw;
    return std::nullopt;
  }
  if (how.recorded) {
    out.record.push_back(map.shown());
    if (!record(state, out)) return std::nullopt;
  }
  return out;
}

// Over the periods after which the motion repeats. `out` has the period before them; false if contact leaves the tip edges that are looked
// at.
bool LinesMotion::record(State& state, MotionRecord& out) {
  const int hunting = hunting_periods();
  const int periods = out.multiple > 0 ? out.multiple
                      : hunting > 1    ? hunting
                                       : Recurrence<Eigen::VectorXd>::kMostMultiple;
  MotionPeriod before = std::move(out.record[0]);
  out.record.resize(static_cast<size_t>(periods));
  for (MotionPeriod& period : out.record) {
    if (!dynamics_->integrate(std::get<SystemDynamics::State>(state), period, &out.energy)) return false;
    dynamics_->take_tooth_loads(period);
    MotionPeriod end = period;
    if (periods > 1) period.begin_with_end_of(before);
    before = std::move(end);
  }
  out.rms = norm_of_rms(out.record);
  take_holding(out);
  return true;
}

// Torques that hold bodies, of a carrier -sum (P - C) x F of its pins as at rest; and the power that comes in.
void LinesMotion::take_holding(MotionRecord& out) const {
  const System& layout = system_.layout;
  const auto periods = static_cast<double>(out.record.size());
  out.holding_torque.setZero(static_cast<Index>(layout.bodies.size()));
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    const System::Body& body = layout.bodies[b];
    const auto at = static_cast<Index>(b);
    if (layout.held(static_cast<int>(b)) && body.kind == System::BodyKind::gear)
      for (const MotionPeriod& period : out.record)
        out.holding_torque[at] += period.contact_torque.row(at).mean() / periods;
    if (body.on == System::kGround || !layout.held(body.on)) continue;
    const System::Body& carrier = layout.bodies[static_cast<size_t>(body.on)];
    const double x = body.centre[0] - carrier.centre[0], y = body.centre[1] - carrier.centre[1];
    for (const MotionPeriod& period : out.record) {
      const Vec2 pin = period.bearing_force[b].rowwise().mean();
      out.holding_torque[body.on] -= carrier.sense * (x * pin.y() - y * pin.x()) / periods;
    }
  }
  if (!(out.energy.friction.sum() > 0)) return;
  out.coefficient = dynamics_->friction();
  for (int b = 0; b < static_cast<int>(layout.bodies.size()); ++b) {
    if (layout.bodies[static_cast<size_t>(b)].on != System::kGround) continue;
    const double torque = layout.held(b) ? out.holding_torque[b] : dynamics_->torque(b),
                 turning = 2 * std::numbers::pi * dynamics_->mesh_frequency() * ground_turns(layout, b);
    out.power_in += std::max(0.0, torque * turning);
  }
}

bool LinesMotion::integrate(State& state, MotionPeriod& period) {
  if (!dynamics_->integrate(std::get<SystemDynamics::State>(state), period)) return false;
  dynamics_->take_tooth_loads(period);
  return true;
}

MotionState LinesMotion::predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency,
                                   int steps) {
  const SystemPeriodMap map(*dynamics_, steps);
  std::vector<KnownOrbit<Eigen::VectorXd>> flat;
  flat.reserve(branch.size());
  for (const KnownOrbit<State>& orbit : branch)
    flat.push_back({orbit.mesh_frequency, map.flat_of(orbit.state)});
  return map.state(whine::predicted(FlatStates{}, flat, mesh_frequency));
}

std::unique_ptr<MotionMap> LinesMotion::map(int steps) {
  return std::make_unique<SystemPeriodMap>(*dynamics_, steps);
}

MotionSource LinesMotion::source() const {
  MotionSource out;
  out.layout = settings_.layout;
  out.damping = settings_.damping;
  out.fidelity = motion_.fidelity;
  out.time = settings_.time;
  out.drive.setZero(out.bodies());
  out.axis_frequency = motion_.axis_frequency / (2 * std::numbers::pi);
  for (size_t b = 0; b < system_.layout.bodies.size(); ++b) {
    const System::Body& body = system_.layout.bodies[b];
    out.drive[static_cast<Index>(b)] = out.layout.torque(static_cast<int>(b));
    out.layout.bodies[b].inertia = body.inertia;
    // On a rigid pin a planet has the mass of its body, of which a moving carrier's pins feel the inertia.
    out.layout.bodies[b].bearing.mass = body.on != System::kGround && !body.bearing.elastic()
                                            ? system_.body[b]->body().mass
                                            : body.bearing.mass;
  }
  out.name_parts();
  return out;
}

}  // namespace whine
