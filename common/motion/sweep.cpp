#include "motion/sweep.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "base/error.h"
#include "motion/dynamics.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostPeriods = 4000;  // per speed, before it counts as not periodic
constexpr int kMostMultiple = 8;    // longest subharmonic looked for, in mesh periods
constexpr double kJumpRatio = 1.2;  // change of RMS across a step that may be a jump
constexpr int kJumpHalvings = 6;    // bisection: a step of 20 Hz leaves 0.3 Hz

// One speed, steady: the last `multiple` periods.
struct Steady {
  int multiple = 1, periods = 0;
  double residual = 0, rms = 0;
  double energy_imbalance = 0;  // relative to the work put in over one period
  std::vector<RollingDynamics::Period> record;
};

double oscillating_rms(const std::vector<RollingDynamics::Period>& record) {
  double sum = 0, square = 0;
  Eigen::Index count = 0;
  for (const auto& period : record) {
    sum += period.transmission_error.sum();
    count += period.transmission_error.size();
  }
  const double mean = sum / static_cast<double>(count);
  for (const auto& period : record) square += (period.transmission_error.array() - mean).square().sum();
  return std::sqrt(square / static_cast<double>(count));
}

class Sweeper {
 public:
  Sweeper(const GearMeshModel& model, const DynamicParameters& parameters, const StaticArtifact& statics,
          const SweepSlice& slice)
      : model_(model), dynamics_(model, parameters), slice_(slice), strips_(statics.contact.strips) {
    load_ = statics.torque / model.kinematics.gear(0).base_radius();
    largest_force_ = 2.5 * load_;
    corner_gap_ = 2.5 * statics.transmission_error.maxCoeff();
    finest_ = steps_at(slice.frequency_from);
    set_range();
    state_ = dynamics_.rest();
  }

  int steps_at(double mesh_frequency) const {
    int steps = slice_.time.steps_per_period;
    while (steps * mesh_frequency < slice_.time.min_sample_rate) steps *= 2;
    return steps;
  }

  const RollingDynamics& dynamics() const { return dynamics_; }
  RollingDynamics::State& state() { return state_; }

  // Runs at this speed from the present state until the state repeats.
  Steady run(double mesh_frequency) {
    const RollingDynamics::State start = state_;
    for (;;) {
      dynamics_.set_speed(mesh_frequency, steps_at(mesh_frequency));
      if (auto steady = settle(mesh_frequency)) return *steady;
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
                      load_ / model_.kinematics.contact_ratio(), largest_force_, corner_gap_),
        finest_);
  }

  std::optional<Steady> settle(double mesh_frequency) {
    Steady steady;
    std::deque<RollingDynamics::State> past{state_};
    RollingDynamics::Period period;
    for (int n = 1; n <= kMostPeriods; ++n) {
      if (!dynamics_.march(state_, period)) return std::nullopt;
      steady.residual = 1e300;
      // The shortest multiple first: a fundamental orbit also repeats after two periods. A subharmonic is
      // looked for only when the transient has had time to die.
      const int longest = n < 100 ? 1 : std::min<int>(kMostMultiple, static_cast<int>(past.size()));
      for (int m = 1; m <= longest; ++m) {
        const double change = dynamics_.distance(state_, past[past.size() - m]);
        if (m == 1) steady.residual = change;
        if (!(change < slice_.time.periodicity)) continue;
        steady.multiple = m;
        steady.residual = change;
        steady.periods = n;
        steady.record.push_back(period);
        for (int k = 1; k < m; ++k) {
          if (!dynamics_.march(state_, period)) return std::nullopt;
          steady.record.push_back(period);
        }
        steady.rms = oscillating_rms(steady.record);
        RollingDynamics::Ledger ledger;
        RollingDynamics::State audited =
            state_;  // the march itself goes on from the state that was found steady
        if (!dynamics_.march(audited, period, &ledger)) return std::nullopt;
        steady.energy_imbalance = ledger.imbalance / ledger.throughput;
        return steady;
      }
      past.push_back(state_);
      if (past.size() > kMostMultiple) past.pop_front();
    }
    fail(Failure::numerical, "at ", mesh_frequency, " Hz the motion is not periodic after ", kMostPeriods,
         " mesh periods: the state still changes by ", steady.residual, " per period (limit ",
         slice_.time.periodicity, "); raise the damping or leave this speed out");
  }

  const GearMeshModel& model_;
  RollingDynamics dynamics_;
  const SweepSlice& slice_;
  int strips_, finest_ = 0, widened_ = 0;
  double load_ = 0, largest_force_ = 0, corner_gap_ = 0;
  RollingDynamics::State state_;
};

bool differs(double a, double b) {
  return std::max(a, b) > kJumpRatio * std::min(a, b);
}

// Between two speeds whose responses differ: follows the branch from the first with ever smaller steps. A
// resonance flank comes back within the ratio, a jump does not.
struct Jump {
  double frequency, width;
};
std::optional<Jump> find_jump(Sweeper& sweeper, const RollingDynamics::State& before, double from,
                              double from_rms, double to, double to_rms) {
  const RollingDynamics::State after = sweeper.state();
  sweeper.state() = before;
  RollingDynamics::State branch = before;
  for (int i = 0; i < kJumpHalvings && differs(from_rms, to_rms); ++i) {
    const double middle = 0.5 * (from + to);
    sweeper.state() = branch;
    const double rms = sweeper.run(middle).rms;
    const auto ratio = [](double a, double b) { return std::max(a, b) / std::min(a, b); };
    if (ratio(from_rms, rms) > ratio(rms, to_rms)) {
      to = middle;
      to_rms = rms;
    } else {
      from = middle;
      from_rms = rms;
      branch = sweeper.state();
    }
  }
  sweeper.state() = after;
  if (!differs(from_rms, to_rms)) return std::nullopt;
  return Jump{0.5 * (from + to), std::abs(to - from)};
}

}  // namespace

SweepArtifact sweep(const BodyArtifact& driver, const BodyArtifact& driven, const StaticArtifact& statics,
                    double mean_stiffness, const SweepSlice& slice, const std::string& direction,
                    const std::function<void(long, long, const std::string&)>& report) {
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
  result.driver = driver.design;
  result.driven = driven.design;
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
  result.direction = direction;
  result.mesh_frequency.resize(speeds);
  result.periods.resize(speeds);
  result.residual.resize(speeds);
  result.period_multiple.resize(speeds);
  result.energy_imbalance.resize(speeds);

  std::vector<Steady> steady;
  std::vector<Jump> jumps;
  for (int i = 0; i < speeds; ++i) {
    const double f = direction == "up" ? slice.frequency_from + i * slice.frequency_step
                                       : slice.frequency_from + (speeds - 1 - i) * slice.frequency_step;
    const RollingDynamics::State before = sweeper.state();
    steady.push_back(sweeper.run(f));
    const Steady& s = steady.back();
    result.mesh_frequency[i] = f;
    result.periods[i] = s.periods;
    result.residual[i] = s.residual;
    result.period_multiple[i] = s.multiple;
    result.energy_imbalance[i] = s.energy_imbalance;
    if (i > 0 && differs(steady[i - 1].rms, s.rms))
      if (const auto jump =
              find_jump(sweeper, before, result.mesh_frequency[i - 1], steady[i - 1].rms, f, s.rms))
        jumps.push_back(*jump);
    report(i + 1, speeds, text(f, " Hz, ", s.periods, " periods"));
  }

  // Rows of one length: every stored row repeats its orbit to the longest multiple that occurs.
  int longest = 1;
  for (const Steady& s : steady)
    while (longest % s.multiple != 0) ++longest;
  const int samples = slice.time.steps_per_period, reach = sweeper.dynamics().reach();
  result.pair = Eigen::VectorXi::LinSpaced(2 * reach + 1, -reach, reach);
  result.transmission_error.resize(speeds, longest * samples);
  result.mesh_force.resize(speeds, longest * samples);
  for (int i = 0; i < speeds; ++i) {
    MatrixRM loads = MatrixRM::Zero(longest * samples, 2 * reach + 1);
    for (int k = 0; k < longest; ++k) {
      const RollingDynamics::Period& period = steady[i].record[k % steady[i].multiple];
      const int stride = static_cast<int>(period.transmission_error.size()) / samples;
      const int own_reach = static_cast<int>(period.pair_load.rows()) / 2;
      for (int n = 0; n < samples; ++n) {
        const int row = k * samples + n;
        result.transmission_error(i, row) = period.transmission_error[n * stride];
        loads.row(row).segment(reach - own_reach, 2 * own_reach + 1) =
            period.pair_load.col(n * stride).transpose();
        result.mesh_force(i, row) = loads.row(row).sum();
      }
    }
    result.tooth_load.push_back(std::move(loads));
  }
  result.jump_frequency.resize(jumps.size());
  result.jump_width.resize(jumps.size());
  for (size_t i = 0; i < jumps.size(); ++i) {
    result.jump_frequency[i] = jumps[i].frequency;
    result.jump_width[i] = jumps[i].width;
  }
  return result;
}

}  // namespace whine
