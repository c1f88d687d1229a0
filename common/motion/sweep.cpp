#include "motion/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "base/error.h"
#include "motion/dynamics.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostPeriods = 3000;  // per speed, before it counts as not periodic
constexpr int kMostMultiple = 8;    // longest subharmonic looked for, in mesh periods
constexpr int kStagnation = 50;     // periods over which a subharmonic must not come nearer to a shorter one
constexpr double kJumpRatio = 1.2;  // change of RMS across a step that may be a jump
constexpr int kJumpHalvings = 6;    // bisection: a step of 20 Hz leaves 0.3 Hz

// One speed, steady: one orbit of `multiple` periods; 0: the motion did not become periodic.
struct Steady {
  int multiple = 1, periods = 0;
  double residual = 0, rms = 0;
  Ledger ledger;  // of the stored periods
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
  // Mean over the mesh period with the contact frozen as the static load leaves it. Hz
  double natural_frequency() {
    constexpr int kPhases = 32;
    const int positions = std::min(kPhases, finest_);
    double sum = 0;
    for (int i = 0; i < positions; ++i) sum += dynamics_.frozen_frequency(i * (finest_ / positions));
    return sum / positions;
  }
  RollingDynamics::State& state() { return state_; }

  // Runs at this speed from the present state until the state repeats.
  Steady run(double mesh_frequency) {
    const RollingDynamics::State start = state_;
    for (;;) {
      dynamics_.set_speed(mesh_frequency, steps_at(mesh_frequency));
      if (auto steady = settle()) return *steady;
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

  // Marches until the state repeats. A subharmonic of order m is one whose state repeats after m periods but, long
  // since and without getting any nearer, not after a divisor of m: a slow transient may look like one for a while.
  std::optional<Steady> settle() {
    Steady steady;
    std::deque<RollingDynamics::State> past{state_};
    std::deque<std::array<double, kMostMultiple + 1>> history;  // change over m periods
    RollingDynamics::Period period;
    for (int n = 1;; ++n) {
      if (!dynamics_.march(state_, period)) return std::nullopt;
      std::array<double, kMostMultiple + 1> change{};
      const int known = static_cast<int>(past.size());
      for (int m = 1; m <= std::min(known, n < kStagnation ? 1 : kMostMultiple); ++m)
        change[m] = dynamics_.distance(state_, past[known - m]);
      const auto stagnates = [&](int m) {
        return static_cast<int>(history.size()) == kStagnation && change[m] > 100 * slice_.time.periodicity &&
               change[m] > 0.999 * history.front()[m];
      };
      int multiple = 0;
      for (int m = 1; m <= std::min(known, kMostMultiple) && multiple == 0; ++m) {
        if (change[m] == 0 || !(change[m] < slice_.time.periodicity)) continue;
        multiple = m;
        for (int d = 1; d < m; ++d)
          if (m % d == 0 && !stagnates(d)) multiple = 0;
      }
      if (change[1] == 0) multiple = 1;
      if (multiple > 0 || n == kMostPeriods) {
        // Not periodic: reported as such, with the last periods as they are.
        const int stored = multiple > 0 ? multiple : kMostMultiple;
        steady.multiple = multiple;
        steady.periods = n;
        steady.residual = change[std::max(multiple, 1)];
        for (int k = 0; k < stored; ++k) {
          if (!dynamics_.march(state_, period, &steady.ledger)) return std::nullopt;
          steady.record.push_back(period);
        }
        steady.rms = oscillating_rms(steady.record);
        return steady;
      }
      past.push_back(state_);
      if (known == kMostMultiple) past.pop_front();
      if (n >= kStagnation) history.push_back(change);
      if (static_cast<int>(history.size()) > kStagnation) history.pop_front();
    }
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
  result.direction = direction;
  result.mesh_frequency.resize(speeds);
  result.periods.resize(speeds);
  result.residual.resize(speeds);
  result.period_multiple.resize(speeds);
  result.energy_imbalance.resize(speeds);
  result.energy.resize(speeds, kEnergyLines.size());
  result.drift_force = VectorXd::Zero(speeds);

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
    const Ledger& l = s.ledger;
    result.energy_imbalance[i] = l.imbalance / l.throughput;
    result.energy.row(i) << l.kinetic, l.modal, l.residual, l.local, l.torque, l.rolling, l.modal_damping,
        l.lag_damping, l.switching, l.cutting, l.averaging;  // kEnergyLines
    if (i > 0 && differs(steady[i - 1].rms, s.rms))
      if (const auto jump =
              find_jump(sweeper, before, result.mesh_frequency[i - 1], steady[i - 1].rms, f, s.rms))
        jumps.push_back(*jump);
    report(i + 1, speeds, text(f, " Hz, ", s.periods, " periods"));
  }

  // Rows of one length: shorter orbits repeat to fill theirs.
  size_t longest = 1;
  for (const Steady& s : steady) longest = std::max(longest, s.record.size());
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
