#include "studies/sweep.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "base/memory.h"
#include "base/model_range.h"
#include "dynamics/dynamics.h"
#include "dynamics/steady_state.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "gear/scene_geometry.h"
#include "signal/branches.h"
#include "signal/jumps.h"
#include "signal/response.h"
#include "studies/face_sweep.h"
#include "studies/speed_sweep.h"
#include "studies/sweep_root_stress.h"
#include "studies/zone_levels.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

int steps_at(const TimeDiscretisation& time, double mesh_frequency) {
  constexpr int kMostSteps = 65536;  // as of steps_per_period
  int steps = time.steps_per_period;
  if (steps < 1)  // a scene cannot say so, stage parameters that were edited can
    fail(Failure::input, "steps_per_period = ", steps,
         " must be at least 1; write the stage parameters from a scene anew");
  while (steps <= kMostSteps && steps * mesh_frequency < time.min_sample_rate) steps *= 2;
  if (steps > kMostSteps)
    fail(Failure::input, "at ", mesh_frequency, " Hz min_sample_rate_kHz = ", time.min_sample_rate * 1e-3,
         " needs ", std::max<double>(steps, time.min_sample_rate / mesh_frequency),
         " steps per mesh period, ", kMostSteps,
         " at most; raise the lowest mesh_frequency_Hz (Hz, not kHz), or lower min_sample_rate_kHz");
  return steps;
}

namespace {

// All motions, and the state that each speed ended with, are kept until the sweep is written.
void require_memory(int hunting, int speeds, const SweepParameters& settings, int pairs, double state) {
  constexpr double kMostMemory = 4e9;  // bytes
  double samples = 0;
  for (int i = 0; i < speeds; ++i)
    samples += settings.time.steps_per_period +
               steps_at(settings.time, settings.frequency_from + i * settings.frequency_step);
  constexpr int kRows = 2 + kSides;  // transmission error, mesh force; root stress of both gears
  const double memory = 8.0 * (samples * hunting * (kRows + pairs) + speeds * state);
  if (memory > kMostMemory)
    fail(Failure::input,
         hunting > 1 ? text("teeth that differ meet again after ", hunting, " mesh periods; ") : "", speeds,
         hunting > 1 ? " speeds of that length need " : " speeds need ", memory * 1e-9, " GB, at most ",
         kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period and min_sample_rate_kHz");
  log_memory(text("the motions at ", speeds, " speeds"), memory);
}

// The pair, on the lowest level of candidate contact zones that holds its motion, whatever the speeds before it wanted; the rig of
// a SpeedSweep.
class PairSweepRig {
 public:
  using State = RollingDynamics::State;
  using Motion = Orbit;
  using Acceleration = RollingAcceleration;

  PairSweepRig(const GearMeshModel& model, const DynamicParameters& parameters, const StaticResult& statics,
               const SweepParameters& settings)
      : settings_(settings),
        finest_(steps_at(settings.time, settings.frequency_from)),
        levels_(model, parameters, statics, finest_) {
    state_ = levels_.at(0).rest();
    hunting_ = dynamics().hunting_periods();
  }

  RollingDynamics& dynamics() { return levels_.at(level_); }
  int single() const { return hunting_; }
  static bool finds_jumps() { return true; }
  static void watch(const std::function<std::vector<State*>()>& /*states*/) {}  // they fit every level
  int reach() const { return levels_.reach(); }
  double natural_frequency() { return levels_.natural_frequency(); }
  const State& state() const { return state_; }
  Acceleration& acceleration() { return acceleration_; }

  // Runs at this speed from the present state until the state repeats, or as iterate_to_orbit() has it.
  Orbit run(double mesh_frequency, const RmsRange& looked_for = {}) {
    const RollingDynamics::State start = state_;
    for (;; ++level_) {
      levels_.require(level_, mesh_frequency);
      if (auto orbit = try_level(mesh_frequency, looked_for))
        return on_lowest_level(mesh_frequency, std::move(*orbit));
      state_ = start;
    }
  }

  Orbit run_from(const State& predicted, double mesh_frequency) {
    const State present = state_;
    const int level = level_;
    state_ = predicted;
    // Returned behind the catch, or clang-tidy takes what follows for never reached.
    std::optional<Orbit> orbit;
    try {
      orbit = run(mesh_frequency);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
    }
    if (orbit) return std::move(*orbit);
    state_ = present;
    level_ = level;
    acceleration_.forget();
    return run(mesh_frequency);
  }
  Orbit follow(const State& predicted, const State& /*last*/, double mesh_frequency,
               const RmsRange& looked_for) {
    state_ = predicted;
    return run(mesh_frequency, looked_for);
  }
  State predicted(const std::vector<KnownOrbit<State>>& known, double mesh_frequency) {
    return whine::predicted(RollingStates{dynamics()}, known, mesh_frequency);
  }
  static BranchMotion motion_at(double mesh_frequency, const Orbit& orbit) {
    return {mesh_frequency, orbit.rms, orbit.multiple};
  }
  static BranchPoint point_at(double mesh_frequency, const Orbit& orbit) {
    BranchPoint point{mesh_frequency, orbit.rms, 0, 0, false};
    for (const RollingDynamics::Period& period : orbit.record) {
      point.tooth_load_max = std::max(point.tooth_load_max, period.tooth_pair_load.maxCoeff());
      point.sustained_load =
          std::max(point.sustained_load, sustained_load(period.tooth_pair_load.transpose(),
                                                        static_cast<int>(period.tooth_pair_load.cols())));
      point.parted = point.parted || !(period.tooth_pair_load.colwise().sum().minCoeff() > 0);
    }
    return point;
  }

 private:
  std::optional<Orbit> try_level(double mesh_frequency, const RmsRange& looked_for = {}) {
    try {
      RollingDynamics& dynamics = levels_.at(level_);
      dynamics.set_speed(mesh_frequency, steps_at(settings_.time, mesh_frequency));
      return iterate_to_orbit(dynamics, state_, settings_.time.periodicity, settings_.time.steady_state,
                              looked_for, &acceleration_);
    } catch (const Error& error) {
      fail_as(error, "at ", mesh_frequency, " Hz, ", error.what());
    }
  }

  // A transient may have wanted more than the orbit does.
  Orbit on_lowest_level(double mesh_frequency, Orbit orbit) {
    while (level_ > 0 && !levels_.keeps_one() && orbit.multiple > 0) {
      const RollingDynamics::State reached = state_;
      --level_;
      std::optional<Orbit> lower;
      try {
        lower = try_level(mesh_frequency);
      } catch (const Error& error) {  // the orbit on the level above stands
        if (error.kind() != Failure::numerical) throw;
      }
      if (!lower || lower->multiple != orbit.multiple) {
        state_ = reached;
        ++level_;
        break;
      }
      lower->periods += orbit.periods;
      orbit = std::move(*lower);
    }
    return orbit;
  }

  const SweepParameters& settings_;
  int finest_ = 0, level_ = 0, hunting_ = 1;
  ZoneLevels levels_;
  RollingDynamics::State state_;
  RollingAcceleration acceleration_;
};

}  // namespace

double stiffness_damping_ratio(const StaticResult& statics, const Damping& damping,
                               const std::array<double, kSides>& inertia) {
  double inverse_mass = 0;
  for (int g = 0; g < kSides; ++g) {
    const double r = ToothGeometry(statics.gear[g].design).base_radius();
    inverse_mass += r * r / inertia[g];
  }
  return 0.5 * damping.rayleigh_stiffness * std::sqrt(statics.mean_stiffness * inverse_mass);
}

double steps_per_oscillation(const SweepResult& sweep) {
  double rate = std::numeric_limits<double>::infinity();  // Hz, of time steps
  for (const double f : sweep.mesh_frequency) rate = std::min(rate, f * steps_at(sweep.time, f));
  return rate / sweep.natural_frequency;
}

namespace {

// m, (speed): by how little the flanks close along the line of action at least: the transmission error less what elastic
// bearings give way. Their dampers' forces are taken for those of their springs.
VectorXd least_closing(const SweepResult& s) {
  VectorXd least(s.mesh_frequency.size());
  if (!s.mesh.on_bearings()) {
    for (Eigen::Index i = 0; i < least.size(); ++i)
      least[i] = s.transmission_error[static_cast<size_t>(i)].minCoeff();
    return least;
  }
  const GearPair gears(s);
  for (Eigen::Index i = 0; i < least.size(); ++i) {
    VectorXd closing = s.transmission_error[static_cast<size_t>(i)].col(0);
    for (size_t g = 0; g < s.bearing_force.size(); ++g)
      if (!s.bearing_force[g].empty())
        closing += (g == 0 ? 1 : -1) / s.mesh.bearing[g].stiffness *
                   (s.bearing_force[g][static_cast<size_t>(i)] * contact_normal(gears));
    least[i] = closing.minCoeff();
  }
  return least;
}

}  // namespace

Eigen::VectorXd backlash_left(const SweepResult& s) {
  // By the samples that are stored: between them a motion swings back further by the square of their distance.
  const VectorXd least = least_closing(s);
  return least.array() - least.minCoeff() + s.backlash_margin;
}

namespace {

// The eta that a scene without [damping] gets is that of P2000's pair; others it damps by what nobody chose.
std::optional<Remark> damping_remark(const StaticResult& statics, const std::array<double, kSides>& inertia,
                                     const Damping& damping) {
  const auto of_paper = [](const BodyParameters& gear) {
    return gear.design.teeth == 50 && std::abs(gear.design.module - 3e-3) < 1e-9;
  };
  const double ratio = stiffness_damping_ratio(statics, damping, inertia);
  const bool fits =
      ratio >= 0.01 && ratio <= 0.12 && std::all_of(statics.gear.begin(), statics.gear.end(), of_paper);
  if (damping.rayleigh_stiffness != kDefaultRayleighStiffness || fits) return {};
  std::ostringstream percent;
  percent << std::setprecision(3) << ratio * 100;
  return remark(
      true, "rayleigh_stiffness_s = ", damping.rayleigh_stiffness,
      ", the default, is for the gears of P2000; these it gives a damping ratio of about ", percent.str(),
      " % (eta w / 2 on the mean mesh stiffness). `make SCENE=path/to/scene.toml calibrate DAMPING=0.07` prints the value for 7 %, to be put into [damping]");
}

}  // namespace

std::vector<Remark> setup_remarks(const StaticResult& statics, const std::array<double, kSides>& inertia,
                                  const Damping& damping, const Fidelity& fidelity) {
  std::vector<Remark> out;
  if (fidelity.body != BodyModel::rigid && fidelity.body != BodyModel::quasi_static)
    if (const auto damped = damping_remark(statics, inertia, damping)) out.push_back(*damped);
  for (int g = 0; g < kSides; ++g) {
    const std::string words =
        flywheel(statics.gear[g].design, statics.gear[g].material, inertia[g], statics.mesh.gear[g]);
    if (!words.empty()) out.push_back(remark(true, words));
  }
  return out;
}

std::vector<Remark> remarks(const SweepResult& s, const StaticResult& statics) {
  constexpr double kFewestSteps = 8;  // an oscillation in so few steps is 5 % off its frequency
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  // Said once of a pair of sweeps, by the one of rising speed.
  if (s.direction == Direction::up && elastic(s)) {
    out = setup_remarks(statics, s.inertia, s.damping, s.fidelity);
    if (s.mesh_frequency.size() > 0) {
      const std::vector<Remark> more =
          schlenk_speed_remarks(s, s.mesh_frequency.minCoeff(), s.mesh_frequency.maxCoeff());
      out.insert(out.end(), more.begin(), more.end());
    }
  }
  if (const double steps = steps_per_oscillation(s); steps < kFewestSteps)
    add(true, "a time step is too long for the contact: ", steps,
        " steps per oscillation at its natural frequency of ", s.natural_frequency, " Hz, ", kFewestSteps,
        " are needed to follow it; raise min_sample_rate_kHz or steps_per_period");
  constexpr double kImbalance = 1e-6;  // of the energy that goes in: what rounding leaves is below 1e-9
  if (Eigen::Index worst = 0;
      s.energy_imbalance.size() > 0 && s.energy_imbalance.cwiseAbs().maxCoeff(&worst) > kImbalance)
    add(true, "the energy balance does not close: at ", s.mesh_frequency[worst], " Hz it is off by ",
        shown_number(std::abs(s.energy_imbalance[worst])), " of the energy that goes in, at most ",
        kImbalance, " is right; do not rely on this sweep, and check [damping]");
  for (Eigen::Index i = 0; i < s.mesh_frequency.size(); ++i)
    if (s.period_multiple[i] == 0)
      add(true, "at ", s.mesh_frequency[i], " Hz the motion is not periodic after ", s.periods[i],
          " mesh periods; the state still changes by ", s.residual[i], " per period");
    else if (s.period_multiple[i] > s.hunting_periods)
      add(false, "at ", s.mesh_frequency[i], " Hz the motion is subharmonic: it repeats after ",
          s.period_multiple[i], " mesh periods");
  // Against the least transmission error at which unloaded teeth touch.
  const double least = least_closing(s).minCoeff() - statics.unloaded_error.minCoeff();
  if (least < 0 && !std::isfinite(s.backlash_margin))
    add(false, "the teeth swing ", std::round(-least * 1e7) / 10,
        " µm apart; tooth_thinning_mm = 0 counts no backlash, so back flanks are left out");
  if (s.backlash_margin <= 0) {
    std::map<double, bool> beyond;
    const Eigen::VectorXd left = backlash_left(s);
    for (Eigen::Index i = 0; i < left.size(); ++i) beyond[s.mesh_frequency[i]] = left[i] <= 0;
    add(true, "at ", speed_ranges(beyond), " Hz the motion goes up to ",
        std::round(-s.backlash_margin * 1e8) / 100,
        " µm beyond the backlash; back flanks would touch there, which is not modelled");
  }
  return out;
}

namespace {

// What one speed shows but for its samples, into its row.
void store_orbit(const Orbit& orbit, double mesh_frequency, Eigen::Index row, SweepResult& a) {
  a.mesh_frequency[row] = mesh_frequency;
  a.periods[row] = orbit.periods;
  a.residual[row] = orbit.residual;
  a.period_multiple[row] = orbit.multiple;
  const EnergyBalance& l = orbit.energy_balance;
  a.energy_imbalance[row] = l.imbalance / l.throughput;
  a.energy.row(row) << l.kinetic, l.modal, l.residual, l.local, l.torque, l.rolling, l.friction_rolling, 0,
      l.modal_damping, 0, l.relaxation_damping, l.friction, l.switching, l.cutting, l.averaging, l.dropped,
      l.throughput;  // kEnergyLines
  if (a.friction.power.size() == 0) return;
  a.friction.power[row] = l.friction * mesh_frequency / static_cast<double>(orbit.record.size());
  const double turning = 2 * std::numbers::pi * mesh_frequency / a.gear[0].design.teeth;  // rad s-1
  a.friction.efficiency[row] = 1 - a.friction.power[row] / (a.torque * turning);
}

// The samples of one speed, pairs up to `reach`; its orbit repeats to fill a row of `longest` mesh periods.
void store_samples(const Orbit& orbit, size_t longest, int reach, SweepResult& a) {
  const int samples = a.time.steps_per_period;
  const auto width = static_cast<Eigen::Index>(longest) * samples;
  MatrixRM loads = MatrixRM::Zero(width, 2 * reach + 1), error(width, 1), force(width, 1);
  for (size_t g = 0; g < kSides; ++g)
    if (a.mesh.bearing[g].elastic()) a.bearing_force[g].emplace_back(width, 2);
  for (size_t k = 0; k < longest; ++k) {
    const RollingDynamics::Period& period = orbit.record[k % orbit.record.size()];
    const int stride = static_cast<int>(period.transmission_error.size()) / samples;
    const int own_reach = static_cast<int>(period.tooth_pair_load.rows()) / 2;
    for (int n = 0; n < samples; ++n) {
      const Eigen::Index at = static_cast<Eigen::Index>(k) * samples + n;
      error(at, 0) = period.transmission_error[n * stride];
      loads.row(at).segment(reach - own_reach, 2 * own_reach + 1) =
          period.tooth_pair_load.col(n * stride).transpose();
      force(at, 0) = loads.row(at).sum();
      for (size_t g = 0; g < kSides; ++g)
        if (a.mesh.bearing[g].elastic())
          a.bearing_force[g].back().row(at) = period.bearing_force[g].col(n * stride).transpose();
    }
  }
  a.tooth_load.push_back(std::move(loads));
  a.transmission_error.push_back(std::move(error));
  a.mesh_force.push_back(std::move(force));
}

// The motions of all speeds, in rows of one length. m: the least transmission error.
double store_motions(const std::vector<Orbit>& steady, int reach, SweepResult& a) {
  size_t longest = 1;
  for (const Orbit& orbit : steady) longest = std::max(longest, orbit.record.size());
  const auto speeds = static_cast<Eigen::Index>(steady.size());
  a.pair = Eigen::VectorXi::LinSpaced(2 * reach + 1, -reach, reach);
  a.drift_force = VectorXd::Zero(speeds);
  double least_error = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < speeds; ++i) {
    const Orbit& orbit = steady[static_cast<size_t>(i)];
    for (const RollingDynamics::Period& period : orbit.record) {
      least_error = std::min(least_error, period.transmission_error.minCoeff());
      a.drift_force[i] = std::max(a.drift_force[i], period.drift_force);
      a.least_gap = std::min(a.least_gap, period.least_gap);
      a.least_force = std::min(a.least_force, period.least_force);
      a.fallbacks += period.fallbacks;
      a.friction_coupling = std::max(a.friction_coupling, period.friction_coupling);
    }
    store_samples(orbit, longest, reach, a);
  }
  return least_error;
}

}  // namespace

std::vector<double> swept_speeds(double from, double to, double step, Direction direction) {
  const int count = static_cast<int>(std::floor((to - from) / step + 1e-9)) + 1;
  if (count < 1 || !(from > 0))
    fail(Failure::input, "the speed range from ", from, " to ", to, " Hz in steps of ", step, " Hz is empty");
  std::vector<double> speeds(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    speeds[static_cast<size_t>(i)] = from + (direction == Direction::up ? i : count - 1 - i) * step;
  return speeds;
}

void require_jump_width(double jump_width) {
  constexpr double kFinest = 1e-5;  // Hz: below, runs beside the end of a branch take thousands of periods
  if (jump_width != 0 && !(jump_width >= kFinest && std::isfinite(jump_width)))
    fail(Failure::input, "jumps cannot be located to ", jump_width, " Hz; give ", kFinest, " Hz or more");
}

void store_jumps(const std::vector<BranchJump>& jumps, VectorXd& frequency, VectorXd& width) {
  frequency.resize(static_cast<Eigen::Index>(jumps.size()));
  width.resize(frequency.size());
  for (size_t i = 0; i < jumps.size(); ++i) {
    frequency[static_cast<Eigen::Index>(i)] = jumps[i].frequency;
    width[static_cast<Eigen::Index>(i)] = jumps[i].width;
  }
}

SweepResult sweep(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                  double mean_stiffness, const SweepParameters& settings, Direction direction,
                  const std::function<void(long, long, const std::string&)>& report,
                  std::vector<BranchPoint>* left_early, double jump_width) {
  if (settings.fidelity.width != WidthModel::one)
    return face_sweep(driver, driven, statics, mean_stiffness, settings, direction, report, jump_width);
  const std::vector<double> speed =
      swept_speeds(settings.frequency_from, settings.frequency_to, settings.frequency_step, direction);
  const auto speeds = static_cast<int>(speed.size());
  require_jump_width(jump_width);
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
  const SystemModel system(driver, driven, statics.mesh);
  const GearMeshModel& model = system.mesh[0];
  report(0, speeds, "candidate contact zone");
  PairSweepRig rig(model, dynamic_parameters(statics, mean_stiffness, settings, settings.frequency_to),
                   statics, settings);

  SweepResult result;
  set_motion(result, {driver, driven}, statics, settings);
  result.time = settings.time;
  result.name_parts();
  result.torque = statics.torque;
  result.mean_stiffness = mean_stiffness;
  for (int g = 0; g < kSides; ++g) result.bearing_damper[g] = rig.dynamics().bearing_damper(g);
  result.natural_frequency = rig.natural_frequency();
  result.hunting_periods = rig.single();
  require_memory(result.hunting_periods, speeds, settings,
                 2 * rig.dynamics().reach() + 1 + (model.on_bearings() ? 4 : 0),
                 static_cast<double>(rig.dynamics().difference(rig.state(), rig.state()).size()));
  result.direction = direction;
  for (VectorXd* v : {&result.mesh_frequency, &result.residual, &result.energy_imbalance}) v->resize(speeds);
  for (Eigen::VectorXi* v : {&result.periods, &result.period_multiple}) v->resize(speeds);
  result.energy.resize(speeds, kEnergyLines.size());
  if (model.friction.acts())
    for (VectorXd* v : {&result.friction.coefficient, &result.friction.power, &result.friction.efficiency})
      v->resize(speeds);

  std::vector<Orbit> steady;
  steady.reserve(speed.size());
  SpeedSweep<PairSweepRig> sweep(rig, settings.time.steady_state);
  sweep.run(speed, report, [&](long i, Orbit&& orbit) {
    const double f = speed[static_cast<size_t>(i)];
    store_orbit(orbit, f, i, result);
    if (model.friction.acts())
      result.friction.coefficient[i] = model.coefficient_of_friction(statics.torque, f);
    steady.push_back(std::move(orbit));
    return text(steady.back().periods, " periods");
  });
  const std::vector<BranchJump> jumps = sweep.jumps(jump_width, left_early, report);

  double least_error = store_motions(steady, rig.reach(), result);
  add_root_stress(system, result);
  if (model.on_bearings()) least_error = least_closing(result).minCoeff();
  result.backlash_margin = result.tooth_thinning() > 0 ? model.kinematics.backlash() + least_error
                                                       : std::numeric_limits<double>::infinity();
  store_jumps(jumps, result.jump_frequency, result.jump_width);
  result.backlash_left = backlash_left(result);
  result.remarks = remarks(result, statics);
  return result;
}

}  // namespace whine
