#include "studies/system_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/memory.h"
#include "dynamics/dynamics.h"
#include "orbits/recurrence.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/branch_rigs.h"
#include "studies/sweep.h"
#include "studies/train_statistics.h"
#include "studies/turning_carrier.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The system from speed to speed.
class SystemSweeper {
 public:
  SystemSweeper(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies)
      : settings_(settings), rig_(settings, bodies), state_(rig_.rest()) {}

  const TrainInMotion& rig() const { return rig_.train(); }
  int hunting_periods() { return rig_.train().dynamics().hunting_periods(); }

  // The periodic motion at a speed, into row `row`.
  std::string run(double frequency, Index row, SystemSweepResult& out) {
    SystemDynamics::State start = state_;
    const int hunting = hunting_periods(), steps = steps_at(settings_.time, frequency);
    try {
      for (;;) {
        Settled settled;
        if (const auto found = rig_.settle(state_, frequency, steps, settings_.time.steady_state))
          settled = *found;
        if (settled.turns > 0 && record(settled, row, out)) {
          motions_.push_back({frequency, rms_, settled.multiple * hunting});
          reached_.push_back(state_);
          return settled.multiple == 1   ? ""
                 : settled.multiple == 0 ? "not periodic"
                                         : text(settled.multiple * hunting, " periods");
        }
        widen({&start});
        state_ = start;
      }
    } catch (const Error& error) {
      fail_as(error, "at a mesh frequency of ", frequency, " Hz, ", error.what());
    }
  }

  // Where the RMS steps along the sweep, of teeth that are alike: the branch is followed there with smaller steps.
  std::vector<BranchJump> jumps(double width, const std::function<void(const std::string&)>& report) {
    std::vector<BranchJump> out;
    for (size_t i = 1; hunting_periods() == 1 && i < motions_.size(); ++i)
      if (may_break(motions_, i)) {
        report(text("what lies between ", motions_[i - 1].mesh_frequency, " and ", motions_[i].mesh_frequency,
                    " Hz"));
        const auto follower = [&] {
          BranchContinuation follow = continuation(i);
          follow.finest = width;
          return follow;
        };
        if (const auto jump = find_jump(motions_, i, follower, nullptr)) out.push_back(*jump);
      }
    return out;
  }

 private:
  using State = TrainRig::State;
  using Known = KnownOrbit<State>;

  void widen(std::vector<State*> states) {
    for (State& state : reached_) states.push_back(&state);
    for (auto* orbits : {&known_, &runs_})
      for (Known& orbit : *orbits) states.push_back(&orbit.state);
    rig_.widen(states);
  }

  // How the branch of the motion i - 1 is followed.
  BranchContinuation continuation(size_t i) {
    const int multiple = motions_[i - 1].multiple;
    size_t first = i - 1;
    while (multiple == 1 && first > 0 && i - first < kKnownOrbits && motions_[first - 1].multiple == 1)
      --first;
    known_.clear();
    runs_.clear();
    for (size_t k = first; k < i; ++k) known_.push_back({motions_[k].mesh_frequency, reached_[k]});
    BranchContinuation follower;
    follower.run = [this](double frequency, double) {
      const BranchMotion motion = run_on(frequency);
      runs_.push_back({frequency, state_});
      return motion;
    };
    follower.keep = [this, multiple](int n) {
      known_.push_back(runs_[static_cast<size_t>(n)]);
      if (multiple != 1 || known_.size() > kKnownOrbits) known_.erase(known_.begin());
      return BranchPoint{};
    };
    return follower;
  }

  // From where the orbits that are known lead, or from the last of them; the RMS as that of the rows. A motion that fails is none of
  // the branch.
  BranchMotion run_on(double frequency) {
    const bool leads = settings_.time.steady_state == SteadyState::extrapolate;
    for (const bool predicts : {true, false}) {
      if (predicts && !leads) continue;
      try {
        return run_from(frequency, predicts);
      } catch (const Error& error) {
        if (error.kind() != Failure::numerical) throw;
      }
    }
    state_ = known_.back().state;
    return {frequency, 0, 0};
  }
  BranchMotion run_from(double frequency, bool predicts) {
    const int steps = steps_at(settings_.time, frequency);
    for (;;) {
      state_ = predicts ? rig_.predicted(known_, frequency, steps) : known_.back().state;
      if (const auto settled = rig_.settle(state_, frequency, steps, settings_.time.steady_state)) {
        TrainStatistics statistics;
        SystemDynamics::Period period;
        int n = 0;
        const int periods = settled->multiple > 0 ? settled->multiple : Recurrence<VectorXd>::kMostMultiple;
        for (; n < periods && rig_.train().dynamics().integrate(state_, period); ++n) statistics.take(period);
        if (n == periods) return {frequency, statistics.dte_rms().norm(), settled->multiple};
      }
      widen({});
    }
  }

  // False if contact leaves the tip edges that are looked at.
  bool record(const Settled& motion, Index row, SystemSweepResult& out) {
    const int hunting = hunting_periods();
    const int periods = hunting * (motion.multiple > 0 ? motion.multiple
                                   : hunting > 1       ? 1
                                                       : Recurrence<VectorXd>::kMostMultiple);
    TrainStatistics recorded;
    SystemEnergyBalance energy;
    double imbalance = 0;
    SystemDynamics::Period period;
    out.energy.row(row).setZero();
    out.rolling.row(row).setZero();
    out.bearing_damping.row(row).setZero();
    out.drift_force[row] = 0;
    out.holding_torque.row(row).setZero();
    begin_samples(periods, row, out);
    for (int n = 0; n < periods; ++n) {
      if (!rig_.train().dynamics().integrate(state_, period, &energy)) return false;
      recorded.take(period);
      take_samples(period, n, row, out);
      take(energy, row, out);
      take_holding(period, static_cast<double>(periods), row, out);
      imbalance += energy.imbalance;
      out.drift_force[row] = std::max(out.drift_force[row], period.drift_force);
      out.least_gap = std::min(out.least_gap, period.least_gap);
      out.least_force = std::min(out.least_force, period.least_force);
    }
    rms_ = recorded.dte_rms().norm();
    out.periods[row] = motion.turns * hunting;
    out.period_multiple[row] = motion.multiple * hunting;
    out.residual[row] = motion.residual;
    out.energy_imbalance[row] = imbalance / out.energy(row, kThroughputLine);
    return true;
  }

  void begin_samples(int periods, Index row, SystemSweepResult& out) const {
    const auto at = static_cast<size_t>(row);
    const Index samples = static_cast<Index>(periods) * settings_.time.steps_per_period,
                meshes = static_cast<Index>(settings_.layout.meshes.size());
    for (auto* x : {&out.transmission_error, &out.mesh_deflection, &out.mesh_force, &out.largest_tooth_load})
      (*x)[at].setZero(samples, meshes);
    for (auto& of_body : out.bearing_force) of_body[at].setZero(samples, 2);
  }

  // Of recorded mesh period k. Sample 0 is that of the last period's end.
  void take_samples(const SystemDynamics::Period& period, int k, Index row, SystemSweepResult& out) const {
    const std::vector<Eigen::Matrix2Xd>& forces = period.bearing_force;
    const Index samples = settings_.time.steps_per_period, stride = period.mesh_force.cols() / samples;
    const auto at = static_cast<size_t>(row);
    const auto put = [&](const auto& of, MatrixRM& rows) {
      for (Index i = 1; i <= samples; ++i)
        rows.row((k * samples + i) % rows.rows()) = of.col(i % samples * stride).transpose();
    };
    put(period.transmission_error, out.transmission_error[at]);
    put(period.mesh_deflection, out.mesh_deflection[at]);
    put(period.mesh_force, out.mesh_force[at]);
    put(period.largest_tooth_force, out.largest_tooth_load[at]);
    for (size_t b = 0; b < forces.size(); ++b) put(forces[b], out.bearing_force[b][at]);
  }

  // Mean over the recorded periods of the torques that hold bodies; of a carrier -sum (P - C) x F of its pins, as at rest.
  void take_holding(const SystemDynamics::Period& period, double periods, Index row,
                    SystemSweepResult& out) const {
    const System& layout = settings_.layout;
    for (size_t b = 0; b < layout.bodies.size(); ++b)
      if (layout.held(static_cast<int>(b)) && layout.bodies[b].kind == System::BodyKind::gear)
        out.holding_torque(row, static_cast<Index>(b)) +=
            period.contact_torque.row(static_cast<Index>(b)).mean() / periods;
    for (size_t b = 0; b < layout.bodies.size(); ++b) {
      const System::Body& body = layout.bodies[b];
      if (body.on == System::kGround || !layout.held(body.on)) continue;
      const System::Body& carrier = layout.bodies[static_cast<size_t>(body.on)];
      const double x = body.centre[0] - carrier.centre[0], y = body.centre[1] - carrier.centre[1];
      const Vec2 pin = period.bearing_force[b].rowwise().mean();
      out.holding_torque(row, body.on) -= carrier.sense * (x * pin.y() - y * pin.x()) / periods;
    }
  }

  static void take(const SystemEnergyBalance& e, Index row, SystemSweepResult& out) {
    Eigen::RowVectorXd lines(static_cast<Index>(kSystemEnergyLines.size()));
    lines << e.kinetic + e.modal + e.residual + e.local, e.drive.sum(), e.rolling.sum(), e.modal_damping,
        e.bearing_damping.sum(), e.relaxation_damping, e.switching.sum(), e.cutting.sum(), e.averaging,
        e.dropped, e.throughput;
    out.energy.row(row) += lines;
    out.rolling.row(row) += e.rolling;
    out.bearing_damping.row(row).head(e.bearing_damping.size()) += e.bearing_damping;
  }

  const SystemSweepParameters& settings_;
  TrainRig rig_;
  State state_;
  double rms_ = 0;  // m, over the meshes, of the motion recorded last
  std::vector<BranchMotion> motions_;
  std::vector<State> reached_;       // [motion]
  std::vector<Known> known_, runs_;  // of a branch that is followed: the last ones on it; all that were tried
  static constexpr size_t kKnownOrbits = 3;
};

}  // namespace

namespace {

// All samples are kept until the sweep is written.
void require_memory_for(const SystemSweepParameters& settings, int hunting, size_t speeds) {
  constexpr double kMostMemory = 4e9;  // bytes
  const double memory = 8.0 * static_cast<double>(speeds) * hunting * settings.time.steps_per_period *
                        (4.0 * static_cast<double>(settings.layout.meshes.size()) +
                         2.0 * static_cast<double>(settings.layout.bodies.size()));
  if (memory > kMostMemory)
    fail(Failure::input,
         hunting > 1 ? text("the same teeth meet again after ", hunting, " mesh periods; ") : "",
         "the samples of ", speeds, " speeds need ", memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period",
         hunting > 1 ? ", or give errors to fewer gears" : "");
  log_memory(text("the samples of ", speeds, " speeds"), memory);
}

}  // namespace

namespace {

// Motions of fewer mesh periods than the longest one repeat.
void fill_rows(SystemSweepResult& a) {
  Index longest = 0;
  for (const MatrixRM& rows : a.transmission_error) longest = std::max(longest, rows.rows());
  const auto fill = [&](std::vector<MatrixRM>& of_speeds) {
    for (MatrixRM& rows : of_speeds) {
      const Index own = rows.rows();
      rows.conservativeResize(longest, rows.cols());
      for (Index i = own; i < longest; ++i) rows.row(i) = rows.row(i - own);
    }
  };
  for (auto* x : {&a.transmission_error, &a.mesh_deflection, &a.mesh_force, &a.largest_tooth_load}) fill(*x);
  for (auto& of_body : a.bearing_force) fill(of_body);
}

}  // namespace

SystemSweepResult system_sweep(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                               Direction direction,
                               const std::function<void(long, long, const std::string&)>& report,
                               double jump_width) {
  const std::vector<double> speeds =
      swept_speeds(settings.frequency_from, settings.frequency_to, settings.frequency_step, direction);
  require_jump_width(jump_width);
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  require_memory_for(settings, whine::hunting_periods(settings), speeds.size());
  report(0, static_cast<long>(speeds.size()), "at rest");
  SystemSweeper sweeper(settings, bodies);
  const TrainInMotion& rig = sweeper.rig();
  const auto n = static_cast<Index>(speeds.size()), meshes = static_cast<Index>(rig.system().mesh.size()),
             all = static_cast<Index>(settings.layout.bodies.size());
  SystemSweepResult out;
  out.settings = rig.used();
  out.direction = direction;
  out.hunting_periods = sweeper.hunting_periods();
  out.torque.setZero(all);
  for (int b = 0; b < all; ++b) out.torque[b] = settings.layout.torque(b);
  out.axis_frequency = rig.motion().axis_frequency / (2 * std::numbers::pi);
  out.mesh_frequency = Eigen::Map<const VectorXd>(speeds.data(), n);
  out.rolling.setZero(n, meshes);
  for (MatrixRM* x : {&out.bearing_damping, &out.holding_torque}) x->setZero(n, all);
  out.energy.setZero(n, static_cast<Index>(kSystemEnergyLines.size()));
  for (VectorXd* x : {&out.residual, &out.energy_imbalance, &out.drift_force}) x->setZero(n);
  out.periods.setZero(n);
  out.period_multiple.setZero(n);
  for (auto* x : {&out.transmission_error, &out.mesh_deflection, &out.mesh_force, &out.largest_tooth_load})
    x->resize(speeds.size());
  out.bearing_force.assign(settings.layout.bodies.size(), std::vector<MatrixRM>(speeds.size()));
  for (Index i = 0; i < n; ++i) {
    report(i, n, text(speeds[static_cast<size_t>(i)], " Hz"));
    const std::string note = sweeper.run(speeds[static_cast<size_t>(i)], i, out);
    report(i + 1, n, text(speeds[static_cast<size_t>(i)], " Hz", note.empty() ? "" : ", ", note));
  }
  fill_rows(out);
  store_jumps(sweeper.jumps(jump_width, [&](const std::string& words) { report(n, n, words); }),
              out.jump_frequency, out.jump_width);
  out.remarks = left_out_of_carriers(out);
  return out;
}

}  // namespace whine
