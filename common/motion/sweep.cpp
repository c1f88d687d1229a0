#include "motion/sweep.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/refusal.h"
#include "contact/lanes.h"
#include "gear/body_inertia.h"
#include "gear/numbers.h"
#include "gear/pair.h"
#include "motion/dynamics.h"
#include "motion/steady_state.h"
#include "signal/branch_end.h"
#include "signal/response.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

int steps_at(const TimeDiscretisation& time, double mesh_frequency) {
  constexpr int kMostSteps = 65536;  // as of steps_per_period
  int steps = time.steps_per_period;
  if (steps < 1)  // a scene cannot say so, a slice that was edited can
    fail(Failure::input, "steps_per_period = ", steps,
         " must be at least 1; cut the slice from a scene anew");
  while (steps * mesh_frequency < time.min_sample_rate) steps *= 2;
  if (steps > kMostSteps)
    fail(Failure::input, "at ", mesh_frequency, " Hz min_sample_rate_kHz = ", time.min_sample_rate * 1e-3,
         " needs ", steps, " steps per mesh period, ", kMostSteps,
         " at most; raise the lowest mesh_frequency_Hz (Hz, not kHz), or lower min_sample_rate_kHz");
  return steps;
}

namespace {

// All motions, and the state that each speed ended with, are kept until the sweep is written.
void require_memory(int hunting, int speeds, const SweepSlice& slice, int pairs, double state) {
  constexpr double kMostMemory = 4e9;  // bytes
  double samples = 0;
  for (int i = 0; i < speeds; ++i)
    samples +=
        slice.time.steps_per_period + steps_at(slice.time, slice.frequency_from + i * slice.frequency_step);
  const double memory = 8.0 * (samples * hunting * (2 + pairs) + speeds * state);
  if (memory > kMostMemory)
    fail(Failure::input,
         hunting > 1 ? text("teeth that differ meet again after ", hunting, " mesh periods; ") : "", speeds,
         hunting > 1 ? " speeds of that length need " : " speeds need ", memory * 1e-9, " GB, at most ",
         kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period and min_sample_rate_kHz");
}

// The pair on contact windows of growing levels, whose strips are of one width: a window holds those of the level below. A
// motion is that of the lowest level that holds it, whatever the speeds before it wanted.
class Sweeper {
 public:
  Sweeper(const GearMeshModel& model, const DynamicParameters& parameters, const StaticArtifact& statics,
          const SweepSlice& slice)
      : model_(model), parameters_(parameters), statics_(statics), slice_(slice) {
    finest_ = steps_at(slice.time, slice.frequency_from);
    lowest_ = range(0);
    state_ = dynamics(0).rest();
    hunting_ = dynamics(0).hunting_periods();
  }

  const RollingDynamics& dynamics() { return dynamics(level_); }
  int hunting_periods() const { return hunting_; }
  int reach() const { return reach_; }  // largest |pair| that any level can touch
  // Mean over the mesh period with the contact frozen as the static load leaves it. Hz
  double natural_frequency() {
    constexpr int kPhases = 32;
    const int positions = std::min(kPhases, finest_);
    double sum = 0;
    // Of teeth that differ other ones at each phase.
    for (int i = 0; i < positions; ++i)
      sum += dynamics(0).frozen_frequency(i * (finest_ / positions),
                                          i * dynamics(0).hunting_periods() / positions);
    return sum / positions;
  }
  RollingDynamics::State& state() { return state_; }
  Secants& secants() { return secants_; }  // to begin the next run with

  // Runs at this speed from the present state until the state repeats, or as settle() has it.
  Orbit run(double mesh_frequency, const RmsRange& looked_for = {}) {
    const RollingDynamics::State start = state_;
    for (;; ++level_) {
      if (level_ > kMostLevel)
        refuse(Failure::numerical, "at ", mesh_frequency, " Hz contact leaves the flanks: forces above ",
               bounds(kMostLevel).force, " N or deflections above ", bounds(kMostLevel).deflection * 1e6,
               " micrometres; lower the torque");
      if (auto orbit = try_level(mesh_frequency, looked_for))
        return on_lowest_level(mesh_frequency, std::move(*orbit));
      state_ = start;
    }
  }

  // The same from a state that is foretold; from the present one if that leads beyond what the contact holds.
  Orbit run_from(const RollingDynamics::State& foretold, double mesh_frequency) {
    const RollingDynamics::State present = state_;
    const int level = level_;
    state_ = foretold;
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
    secants_.forget();
    return run(mesh_frequency);
  }

 private:
  static constexpr double kWidening = 1.6;
  static constexpr int kMostLevel = 8;

  MotionBounds bounds(int level) const { return {model_, statics_, std::pow(kWidening, level)}; }

  std::optional<Orbit> try_level(double mesh_frequency, const RmsRange& looked_for = {}) {
    try {
      RollingDynamics& dynamics = this->dynamics(level_);
      dynamics.set_speed(mesh_frequency, steps_at(slice_.time, mesh_frequency));
      return settle(dynamics, state_, slice_.time.periodicity, slice_.time.steady_state, looked_for,
                    &secants_);
    } catch (const Error& error) {
      fail_as(error, "at ", mesh_frequency, " Hz, ", error.what());
    }
  }

  // A transient may have wanted more than the orbit does.
  Orbit on_lowest_level(double mesh_frequency, Orbit orbit) {
    while (level_ > 0 && !keeps_one_level() && orbit.multiple > 0) {
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

  ContactRange range(int level) const {
    ContactRange range = contact_range(model_, statics_, bounds(level));
    if (level > 0) {
      const double wider = range.half_window / lowest_.half_window;
      range.strips = padded(static_cast<int>(std::ceil(wider * lowest_.strips)));
      range.half_window = lowest_.half_window * range.strips / lowest_.strips;
    }
    return range;
  }

  // Every mode of a mesh fills the memory once.
  bool keeps_one_level() const { return slice_.fidelity.body == "full"; }
  RollingDynamics& dynamics(int level) {
    if (static_cast<int>(levels_.size()) <= level) levels_.resize(level + 1);
    if (!levels_[level]) {
      if (keeps_one_level())
        for (auto& other : levels_) other.reset();
      WindowMemory held;
      for (const auto& other : levels_)
        if (other) {
          held.coordinates += other->memory().coordinates;
          held.gaps += other->memory().gaps;
        }
      levels_[level] = std::make_unique<RollingDynamics>(model_, parameters_);
      levels_[level]->set_range(range(level), finest_, held);
      levels_[level]->rest();  // sets the scale of distances
      reach_ = std::max(reach_, levels_[level]->reach());
    }
    return *levels_[level];
  }

  const GearMeshModel& model_;
  DynamicParameters parameters_;
  const StaticArtifact& statics_;
  const SweepSlice& slice_;
  int finest_ = 0, level_ = 0, reach_ = 0, hunting_ = 1;
  ContactRange lowest_;
  std::vector<std::unique_ptr<RollingDynamics>> levels_;
  RollingDynamics::State state_;
  Secants secants_;
};

BranchPoint branch_point(double mesh_frequency, const Orbit& orbit) {
  BranchPoint point{mesh_frequency, orbit.rms, 0, 0, false};
  for (const RollingDynamics::Period& period : orbit.record) {
    point.tooth_load_max = std::max(point.tooth_load_max, period.pair_load.maxCoeff());
    point.held_load = std::max(
        point.held_load, held_load(period.pair_load.transpose(), static_cast<int>(period.pair_load.cols())));
    point.parted = point.parted || !(period.pair_load.colwise().sum().minCoeff() > 0);
  }
  return point;
}

BranchMotion branch_motion(double mesh_frequency, const Orbit& orbit) {
  return {mesh_frequency, orbit.rms, orbit.multiple};
}

// Runs from where the motions of the last speeds lead, which is nearer to the motion at the next speed than where the last
// one ended, and on the branch up to where it ends; from where that one ended where the RMS does not go on evenly (by more than
// some 8 % a step, or as across a jump).
Orbit run_on(Sweeper& sweeper, const std::vector<BranchMotion>& motions,
             const std::vector<RollingDynamics::State>& reached, double mesh_frequency) {
  constexpr size_t kMostKnown = 3;
  const size_t n = motions.size();
  const auto even = [&](size_t i) {
    const int single = sweeper.hunting_periods();
    return motions[i - 1].multiple == single && motions[i].multiple == single && !may_break(motions, i);
  };
  size_t first = n;
  while (first > 1 && n - first < kMostKnown - 1 && even(first - 1)) --first;
  if (first == n) {
    sweeper.secants().forget();
    return sweeper.run(mesh_frequency);
  }
  std::vector<KnownOrbit> known;
  for (size_t i = first - 1; i < n; ++i) known.push_back({motions[i].mesh_frequency, reached[i]});
  return sweeper.run_from(foretold(sweeper.dynamics(), known, mesh_frequency), mesh_frequency);
}

struct Jump {
  double frequency, width;
};
// Between the speeds i - 1 and i of a sweep, or beyond where the sweep left the branch early; nothing if the branch leads from
// one to the other. reached: the states at the end of speeds.
std::optional<Jump> find_jump(Sweeper& sweeper, const std::vector<BranchMotion>& motions, size_t i,
                              const std::vector<RollingDynamics::State>& reached, bool march,
                              std::vector<BranchPoint>* left_early) {
  const BranchMotion &from = motions[i - 1], &to = motions[i];
  const double width = std::abs(to.mesh_frequency - from.mesh_frequency);
  const Jump whole{0.5 * (from.mesh_frequency + to.mesh_frequency), width};
  if (from.multiple == 0) return whole;
  struct Run {
    Orbit orbit;
    KnownOrbit end;
    Secants secants;
  };
  std::vector<Run> runs;
  std::vector<KnownOrbit> branch;
  Secants secants;  // of the branch
  double rms = from.rms;
  // Of a subharmonic nothing says in which of its periods a run ends.
  const bool single = from.multiple == sweeper.hunting_periods();
  size_t first = i - 1;
  while (single && first > 0 && i - first < 3 && motions[first - 1].multiple == from.multiple) --first;
  for (size_t k = first; k < i; ++k) branch.push_back({motions[k].mesh_frequency, reached[k]});
  std::vector<BranchPoint> points;
  BranchWalk walk;
  walk.step = to.mesh_frequency - from.mesh_frequency;
  walk.limit = motions.back().mesh_frequency;
  walk.run = [&](double mesh_frequency, double most) {
    sweeper.state() = march ? branch.back().state : foretold(sweeper.dynamics(), branch, mesh_frequency);
    sweeper.secants() = secants;
    const Orbit orbit = sweeper.run(mesh_frequency, single ? RmsRange{rms / most, rms * most} : RmsRange{});
    runs.push_back({orbit, {mesh_frequency, sweeper.state()}, sweeper.secants()});
    return branch_motion(mesh_frequency, orbit);
  };
  walk.keep = [&](int n) {
    branch.push_back(runs[n].end);
    secants = runs[n].secants;
    if (!single || branch.size() > 3) branch.erase(branch.begin());
    rms = runs[n].orbit.rms;
    points.push_back(branch_point(runs[n].end.mesh_frequency, runs[n].orbit));
  };
  const auto end = branch_end(walk, motions, i);
  if (!end) return std::nullopt;
  if (left_early) left_early->insert(left_early->end(), points.begin(), points.end());
  if (end->outlived) return whole;
  return Jump{0.5 * (end->last + end->next), std::abs(end->next - end->last)};
}

}  // namespace

double stiffness_damping_ratio(const StaticArtifact& statics, const Damping& damping, double driver_inertia,
                               double driven_inertia) {
  double inverse_mass = 0;
  for (const auto& [design, inertia] :
       {std::pair{&statics.driver, driver_inertia}, std::pair{&statics.driven, driven_inertia}}) {
    const double r = ToothGeometry(*design).base_radius();
    inverse_mass += r * r / inertia;
  }
  return 0.5 * damping.rayleigh_stiffness * std::sqrt(statics.mean_stiffness * inverse_mass);
}

double steps_per_oscillation(const SweepArtifact& sweep) {
  double rate = std::numeric_limits<double>::infinity();  // Hz, of time steps
  for (const double f : sweep.mesh_frequency) rate = std::min(rate, f * steps_at(sweep.time, f));
  return rate / sweep.natural_frequency;
}

namespace {

// m, (speed): by how little the flanks close along the line of action at least: the transmission error less what elastic bearings
// give way. Their dampers' forces are taken for those of their springs.
VectorXd least_closing(const SweepArtifact& s) {
  if (!s.mesh.on_bearings()) return s.transmission_error.rowwise().minCoeff();
  const GearPair gears(s.driver, s.driven, s.mesh.centre_distance);
  VectorXd least(s.transmission_error.rows());
  for (Eigen::Index i = 0; i < least.size(); ++i) {
    VectorXd closing = s.transmission_error.row(i).transpose();
    for (size_t g = 0; g < 2; ++g)
      if (!s.bearing_force[g].empty())
        closing += (g == 0 ? 1 : -1) / s.mesh.bearing[g].stiffness *
                   (s.bearing_force[g][static_cast<size_t>(i)] * contact_normal(gears));
    least[i] = closing.minCoeff();
  }
  return least;
}

}  // namespace

Eigen::VectorXd backlash_left(const SweepArtifact& s) {
  // By the samples that are stored: between them a motion swings back further by the square of their distance.
  const VectorXd least = least_closing(s);
  return least.array() - least.minCoeff() + s.backlash_margin;
}

namespace {

// The eta that a scene without [damping] gets is that of P2000's pair; others it damps by what nobody chose.
std::optional<Remark> damping_remark(const StaticArtifact& statics, const std::array<double, 2>& inertia,
                                     const Damping& damping) {
  const auto of_paper = [](const GearDesign& g) { return g.teeth == 50 && std::abs(g.module - 3e-3) < 1e-9; };
  const double ratio = stiffness_damping_ratio(statics, damping, inertia[0], inertia[1]);
  const bool fits = of_paper(statics.driver) && of_paper(statics.driven) && ratio >= 0.01 && ratio <= 0.12;
  if (damping.rayleigh_stiffness != kDefaultRayleighStiffness || fits) return {};
  std::ostringstream percent;
  percent << std::setprecision(3) << ratio * 100;
  return remark(
      true, "rayleigh_stiffness_s = ", damping.rayleigh_stiffness,
      ", the default, is for the gears of P2000; these it gives a damping ratio of about ", percent.str(),
      " % (eta w / 2 on the mean mesh stiffness). `make SCENE=path/to/scene.toml calibrate DAMPING=0.07` "
      "prints the value for 7 %, to be put into [damping]");
}

}  // namespace

std::vector<Remark> setup_remarks(const StaticArtifact& statics, const std::array<double, 2>& inertia,
                                  const Damping& damping, const Fidelity& fidelity) {
  constexpr double kFlywheel =
      100;  // times the inertia of the drawing: more than what shafts and couplings add
  std::vector<Remark> out;
  if (fidelity.body != "rigid" && fidelity.body != "quasi-static")
    if (const auto damped = damping_remark(statics, inertia, damping)) out.push_back(*damped);
  for (size_t g = 0; g < 2; ++g) {
    const double own = least_body_inertia(ToothGeometry(g ? statics.driven : statics.driver),
                                          g ? statics.driven_material : statics.driver_material);
    if (inertia[g] > kFlywheel * own)
      out.push_back(remark(true, "total_inertia_kgm2 = ", inertia[g], " of [gear.",
                           g ? statics.mesh.driven : statics.mesh.driver, "] is ",
                           std::round(inertia[g] / own), " times that of the gear as drawn, ",
                           shown_number(own), "; check its unit, kg m2"));
  }
  return out;
}

std::vector<Remark> remarks(const SweepArtifact& s, const StaticArtifact& statics) {
  constexpr double kFewestSteps = 8;  // an oscillation in so few steps is 5 % off its frequency
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  // Said once of a pair of sweeps, by the one of rising speed.
  if (s.direction == "up" && s.model == "finite elements")
    out = setup_remarks(statics, {s.driver_inertia, s.driven_inertia}, s.damping, s.fidelity);
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

SweepArtifact sweep(const BodyArtifact& driver, const BodyArtifact& driven, const StaticArtifact& statics,
                    double mean_stiffness, const SweepSlice& slice, const std::string& direction,
                    const std::function<void(long, long, const std::string&)>& report,
                    std::vector<BranchPoint>* left_early) {
  const int speeds = static_cast<int>(std::floor(
                         (slice.frequency_to - slice.frequency_from) / slice.frequency_step + 1e-9)) +
                     1;
  if (speeds < 1 || !(slice.frequency_from > 0))
    fail(Failure::input, "the speed range from ", slice.frequency_from, " to ", slice.frequency_to,
         " Hz in steps of ", slice.frequency_step, " Hz is empty");

  require_inertia(statics.mesh, {driver.inertia, driven.inertia},
                  {slice.driver_inertia, slice.driven_inertia});
  const GearMeshModel model(driver, driven, statics.mesh);
  DynamicParameters parameters;
  parameters.torque = statics.torque;
  parameters.inertia = {slice.driver_inertia, slice.driven_inertia};
  parameters.mean_stiffness = mean_stiffness;
  parameters.damping = slice.damping;
  parameters.fidelity = slice.fidelity;
  Sweeper sweeper(model, parameters, statics, slice);

  SweepArtifact result;
  set_gears(result, driver, driven);
  result.mesh = statics.mesh;
  result.fidelity = slice.fidelity;
  result.contact = statics.contact;
  result.time = slice.time;
  result.damping = slice.damping;
  result.torque = statics.torque;
  result.driver_inertia = slice.driver_inertia;
  result.driven_inertia = slice.driven_inertia;
  result.mean_stiffness = mean_stiffness;
  result.driver_bearing_damper = sweeper.dynamics().bearing_damper(0);
  result.driven_bearing_damper = sweeper.dynamics().bearing_damper(1);
  result.natural_frequency = sweeper.natural_frequency();
  result.hunting_periods = sweeper.hunting_periods();
  require_memory(result.hunting_periods, speeds, slice,
                 2 * sweeper.dynamics().reach() + 1 + (model.on_bearings() ? 4 : 0),
                 static_cast<double>(sweeper.dynamics().difference(sweeper.state(), sweeper.state()).size()));
  result.direction = direction;
  result.mesh_frequency.resize(speeds);
  result.periods.resize(speeds);
  result.residual.resize(speeds);
  result.period_multiple.resize(speeds);
  result.energy_imbalance.resize(speeds);
  result.energy.resize(speeds, kEnergyLines.size());
  result.drift_force = VectorXd::Zero(speeds);

  const auto speed = [&](int i) { return slice.frequency_from + i * slice.frequency_step; };
  std::vector<Orbit> steady;
  std::vector<BranchMotion> motions;
  std::vector<RollingDynamics::State> reached;
  for (int i = 0; i < speeds; ++i) {
    const double f = speed(direction == "up" ? i : speeds - 1 - i);
    steady.push_back(slice.time.steady_state == "march" ? sweeper.run(f)
                                                        : run_on(sweeper, motions, reached, f));
    motions.push_back(branch_motion(f, steady.back()));
    reached.push_back(sweeper.state());
    const Orbit& s = steady.back();
    result.mesh_frequency[i] = f;
    result.periods[i] = s.periods;
    result.residual[i] = s.residual;
    result.period_multiple[i] = s.multiple;
    const Ledger& l = s.ledger;
    result.energy_imbalance[i] = l.imbalance / l.throughput;
    result.energy.row(i) << l.kinetic, l.modal, l.residual, l.local, l.torque, l.rolling, l.modal_damping,
        l.lag_damping, l.switching, l.cutting, l.averaging, l.forgetting;  // kEnergyLines
    report(i + 1, speeds, text(f, " Hz, ", s.periods, " periods"));
  }

  std::vector<Jump> jumps;
  for (size_t i = 1; i < motions.size(); ++i)
    if (may_break(motions, i))
      if (const auto jump =
              find_jump(sweeper, motions, i, reached, slice.time.steady_state == "march", left_early))
        jumps.push_back(*jump);

  // Rows of one length: shorter orbits repeat to fill theirs.
  size_t longest = 1;
  for (const Orbit& s : steady) longest = std::max(longest, s.record.size());
  const int samples = slice.time.steps_per_period, reach = sweeper.reach();
  result.pair = Eigen::VectorXi::LinSpaced(2 * reach + 1, -reach, reach);
  result.transmission_error.resize(speeds, longest * samples);
  result.mesh_force.resize(speeds, longest * samples);
  double least_error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < speeds; ++i) {
    MatrixRM loads = MatrixRM::Zero(longest * samples, 2 * reach + 1);
    for (int g = 0; g < 2; ++g)
      if (model.bearing[g].elastic()) result.bearing_force[g].emplace_back(longest * samples, 2);
    for (const RollingDynamics::Period& period : steady[i].record) {
      least_error = std::min(least_error, period.transmission_error.minCoeff());
      result.drift_force[i] = std::max(result.drift_force[i], period.drift_force);
      result.least_gap = std::min(result.least_gap, period.least_gap);
      result.least_force = std::min(result.least_force, period.least_force);
      result.fallbacks += period.fallbacks;
    }
    for (size_t k = 0; k < longest; ++k) {
      const RollingDynamics::Period& period = steady[i].record[k % steady[i].record.size()];
      const int stride = static_cast<int>(period.transmission_error.size()) / samples;
      const int own_reach = static_cast<int>(period.pair_load.rows()) / 2;
      for (int n = 0; n < samples; ++n) {
        const int row = static_cast<int>(k) * samples + n;
        result.transmission_error(i, row) = period.transmission_error[n * stride];
        loads.row(row).segment(reach - own_reach, 2 * own_reach + 1) =
            period.pair_load.col(n * stride).transpose();
        result.mesh_force(i, row) = loads.row(row).sum();
        for (int g = 0; g < 2; ++g)
          if (model.bearing[g].elastic())
            result.bearing_force[g].back().row(row) = period.bearing_force[g].col(n * stride).transpose();
      }
    }
    result.tooth_load.push_back(std::move(loads));
  }
  if (model.on_bearings()) least_error = least_closing(result).minCoeff();
  result.backlash_margin = driver.design.tooth_thinning + driven.design.tooth_thinning > 0
                               ? model.kinematics.backlash() + least_error
                               : std::numeric_limits<double>::infinity();
  result.jump_frequency.resize(jumps.size());
  result.jump_width.resize(jumps.size());
  for (size_t i = 0; i < jumps.size(); ++i) {
    result.jump_frequency[i] = jumps[i].frequency;
    result.jump_width[i] = jumps[i].width;
  }
  return result;
}

}  // namespace whine
