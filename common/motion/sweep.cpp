#include "motion/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "motion/dynamics.h"
#include "motion/steady_state.h"
#include "signal/response.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostSteps = 65536;  // per mesh period, as of steps_per_period
constexpr int kJumpFineness = 64;  // steps of the sweep are halved down to this part: 20 Hz leave 0.3 Hz

int steps_at(const TimeDiscretisation& time, double mesh_frequency) {
  int steps = time.steps_per_period;
  while (steps * mesh_frequency < time.min_sample_rate) steps *= 2;
  if (steps > kMostSteps)
    fail(Failure::input, "at ", mesh_frequency, " Hz min_sample_rate_kHz = ", time.min_sample_rate * 1e-3,
         " needs ", steps, " steps per mesh period, ", kMostSteps,
         " at most; raise the lowest mesh_frequency_Hz, or lower min_sample_rate_kHz");
  return steps;
}

// All motions are kept until the sweep is written.
void require_memory(int hunting, int speeds, const SweepSlice& slice, int pairs) {
  constexpr double kMostMemory = 4e9;  // bytes
  double samples = 0;
  for (int i = 0; i < speeds; ++i)
    samples +=
        slice.time.steps_per_period + steps_at(slice.time, slice.frequency_from + i * slice.frequency_step);
  const double memory = 8.0 * samples * hunting * (2 + pairs);
  if (hunting > 1 && memory > kMostMemory)
    fail(Failure::input, "teeth that differ meet again after ", hunting, " mesh periods; ", speeds,
         " speeds of that length need ", memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period and min_sample_rate_kHz");
}

class Sweeper {
 public:
  Sweeper(const GearMeshModel& model, const DynamicParameters& parameters, const StaticArtifact& statics,
          const SweepSlice& slice)
      : model_(model), dynamics_(model, parameters), slice_(slice), strips_(statics.contact.strips) {
    load_ = statics.torque / model.kinematics.gear(0).base_radius();
    largest_force_ = 2.5 * load_;
    // Beside what load adds: teeth that differ are near or far as they are.
    const Eigen::VectorXd& without_load = statics.unloaded_error;
    corner_gap_ = statics.hunting_periods == 1
                      ? 2.5 * statics.transmission_error.maxCoeff()
                      : 2.5 * (statics.transmission_error - without_load).maxCoeff() +
                            std::max(0.0, without_load.maxCoeff());
    finest_ = steps_at(slice.time, slice.frequency_from);
    set_range();
    state_ = dynamics_.rest();
  }

  const RollingDynamics& dynamics() const { return dynamics_; }
  // Mean over the mesh period with the contact frozen as the static load leaves it. Hz
  double natural_frequency() {
    constexpr int kPhases = 32;
    const int positions = std::min(kPhases, finest_);
    double sum = 0;
    // Of teeth that differ other ones at each phase.
    for (int i = 0; i < positions; ++i)
      sum +=
          dynamics_.frozen_frequency(i * (finest_ / positions), i * dynamics_.hunting_periods() / positions);
    return sum / positions;
  }
  RollingDynamics::State& state() { return state_; }

  // Runs at this speed from the present state until the state repeats.
  Orbit run(double mesh_frequency) {
    const RollingDynamics::State start = state_;
    for (;;) {
      try {
        dynamics_.set_speed(mesh_frequency, steps_at(slice_.time, mesh_frequency));
        if (auto orbit = settle(dynamics_, state_, slice_.time.periodicity, slice_.time.steady_state))
          return *orbit;
      } catch (const Error& error) {
        fail(error.kind(), "at ", mesh_frequency, " Hz, ", error.what());
      }
      // Contact wanted more than the window or the corner range holds: widen and run this speed again.
      if (++widened_ > 8)
        fail(Failure::numerical, "at ", mesh_frequency, " Hz contact leaves the flanks: forces above ",
             largest_force_, " N or deflections above ", corner_gap_ * 1e6, " micrometres; lower the torque");
      largest_force_ *= 1.6;
      corner_gap_ *= 1.6;
      set_range();
      state_ = start;
    }
  }

 private:
  void set_range() {
    dynamics_.set_range(
        contact_range(model_.kinematics, model_.gear[0].half_plane(), model_.gear[1].half_plane(), strips_,
                      load_ / model_.kinematics.contact_ratio(), largest_force_, corner_gap_,
                      model_.flanks()),
        finest_);
  }

  const GearMeshModel& model_;
  RollingDynamics dynamics_;
  const SweepSlice& slice_;
  int strips_, finest_ = 0, widened_ = 0;
  double load_ = 0, largest_force_ = 0, corner_gap_ = 0;
  RollingDynamics::State state_;
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

// Between two speeds whose responses differ: follows the branch of the first, with steps that are halved where they leave
// it, to where it ends - past the second speed too, since a long step leaves a branch early whose basin has become
// narrow. Nothing if the branch passes through the response at the second speed: a resonance flank, no jump.
struct Jump {
  double frequency, width;
};
std::optional<Jump> find_jump(Sweeper& sweeper, const RollingDynamics::State& before, double from,
                              double from_rms, double to, double to_rms, double limit,
                              std::vector<BranchPoint>* left_early) {
  const RollingDynamics::State after = sweeper.state();
  RollingDynamics::State branch = before;
  double at = from, rms = from_rms, step = 0.5 * (to - from);
  const double direction = to > from ? 1 : -1, finest = std::abs(to - from) / kJumpFineness;
  std::optional<Jump> jump;
  std::vector<BranchPoint> points;
  for (bool passed = false; std::abs(step) >= finest;) {
    // Speeds of the sweep are met, so that the branch can be compared there.
    double next = at + step;
    if (!passed && direction * (next - to) > 0) next = to;
    if (direction * (next - limit) > 0) {  // the branch outlives the sweep, which left it within this step
      jump = Jump{0.5 * (from + to), std::abs(to - from)};
      break;
    }
    sweeper.state() = branch;
    const Orbit orbit = sweeper.run(next);
    const double found = orbit.rms;
    if (like_a_jump(rms, found)) {
      step *= 0.5;
      jump = Jump{0.5 * (at + next), std::abs(next - at)};
      continue;
    }
    at = next;
    rms = found;
    branch = sweeper.state();
    points.push_back(branch_point(next, orbit));
    if (at == to) {
      passed = true;
      if (!like_a_jump(found, to_rms)) {
        jump.reset();
        break;
      }
    }
  }
  sweeper.state() = after;
  if (jump && left_early) left_early->insert(left_early->end(), points.begin(), points.end());
  return jump;
}

}  // namespace

double stiffness_damping_ratio(const StaticArtifact& statics, const SweepSlice& slice) {
  double inverse_mass = 0;
  for (const auto& [design, inertia] :
       {std::pair{&statics.driver, slice.driver_inertia}, std::pair{&statics.driven, slice.driven_inertia}}) {
    const double r = ToothGeometry(*design).base_radius();
    inverse_mass += r * r / inertia;
  }
  return 0.5 * slice.damping.rayleigh_stiffness * std::sqrt(statics.mean_stiffness * inverse_mass);
}

double steps_per_oscillation(const SweepArtifact& sweep) {
  double rate = std::numeric_limits<double>::infinity();  // Hz, of time steps
  for (const double f : sweep.mesh_frequency) rate = std::min(rate, f * steps_at(sweep.time, f));
  return rate / sweep.natural_frequency;
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
  result.hunting_periods = sweeper.dynamics().hunting_periods();
  require_memory(result.hunting_periods, speeds, slice, 2 * sweeper.dynamics().reach() + 1);
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
  std::vector<Jump> jumps;
  for (int i = 0; i < speeds; ++i) {
    const double f = speed(direction == "up" ? i : speeds - 1 - i);
    const RollingDynamics::State before = sweeper.state();
    steady.push_back(sweeper.run(f));
    const Orbit& s = steady.back();
    result.mesh_frequency[i] = f;
    result.periods[i] = s.periods;
    result.residual[i] = s.residual;
    result.period_multiple[i] = s.multiple;
    const Ledger& l = s.ledger;
    result.energy_imbalance[i] = l.imbalance / l.throughput;
    result.energy.row(i) << l.kinetic, l.modal, l.residual, l.local, l.torque, l.rolling, l.modal_damping,
        l.lag_damping, l.switching, l.cutting, l.averaging, l.forgetting;  // kEnergyLines
    if (i > 0 && like_a_jump(steady[i - 1].rms, s.rms))
      if (const auto jump = find_jump(sweeper, before, result.mesh_frequency[i - 1], steady[i - 1].rms, f,
                                      s.rms, direction == "up" ? speed(speeds - 1) : speed(0), left_early))
        jumps.push_back(*jump);
    report(i + 1, speeds, text(f, " Hz, ", s.periods, " periods"));
  }

  // Rows of one length: shorter orbits repeat to fill theirs.
  size_t longest = 1;
  for (const Orbit& s : steady) longest = std::max(longest, s.record.size());
  const int samples = slice.time.steps_per_period, reach = sweeper.dynamics().reach();
  result.pair = Eigen::VectorXi::LinSpaced(2 * reach + 1, -reach, reach);
  result.transmission_error.resize(speeds, longest * samples);
  result.mesh_force.resize(speeds, longest * samples);
  double least_error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < speeds; ++i) {
    MatrixRM loads = MatrixRM::Zero(longest * samples, 2 * reach + 1);
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
      }
    }
    result.tooth_load.push_back(std::move(loads));
  }
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
