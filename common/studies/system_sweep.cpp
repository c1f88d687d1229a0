#include "studies/system_sweep.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/model_range.h"
#include "dynamics/dynamics.h"
#include "gear/system_layout.h"
#include "orbits/recurrence.h"
#include "studies/branch_rigs.h"
#include "studies/motion_statistics.h"
#include "studies/speed_sweep.h"
#include "studies/sweep.h"
#include "studies/sweep_root_stress.h"
#include "studies/turning_carrier.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// What a train settled into; along a branch that is followed its RMS alone.
struct TrainMotion {
  Settled settled{0, 0, 0};
  double rms = 0;  // m, over the meshes
  // Over the recorded periods: (sample, mesh), (sample, mesh and within it tooth_pair) from first_pair on, [body] (sample, xy)
  MatrixRM transmission_error, mesh_deflection, mesh_force, tooth_load;
  int first_pair = 0;
  std::vector<SystemDynamics::FacePeak> face;  // [mesh] in slices
  std::vector<MatrixRM> bearing_force;
  // J: by line of kEnergyLines, mesh, body; N m, by body
  Eigen::RowVectorXd energy, rolling, bearing_damping, holding_torque;
  VectorXd friction;                                         // (mesh) J
  double coefficient = 0, friction_power = 0, power_in = 0;  // 1, W, W: see FrictionLosses
  double imbalance = 0, drift_force = 0, least_gap = 0, least_force = 0, friction_coupling = 0;
};

// A train with the tip edges that are looked at; the rig of a SpeedSweep.
class TrainSweepRig {
 public:
  using State = TrainRig::State;
  using Motion = TrainMotion;
  struct Acceleration {
    AndersonAcceleration<FlatStates> columns;
    int widenings = 0;  // of the train that they are of
    void forget() { columns.forget(); }
  };

  TrainSweepRig(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies)
      : settings_(settings), rig_(settings, bodies), state_(rig_.rest()) {}

  const TrainInMotion& train() const { return rig_.train(); }
  int single() { return rig_.train().dynamics().hunting_periods(); }
  bool finds_jumps() { return single() == 1; }
  void watch(std::function<std::vector<State*>()> states) { states_ = std::move(states); }
  const State& state() const { return state_; }
  Acceleration& acceleration() { return acceleration_; }
  State predicted(const std::vector<KnownOrbit<State>>& known, double frequency) {
    return rig_.predicted(known, frequency, steps_at(settings_.time, frequency));
  }

  Motion run(double frequency) { return run(frequency, true, nullptr); }
  Motion run_from(const State& predicted, double frequency) {
    State present = std::exchange(state_, predicted);
    if (auto motion = tried(frequency, true, &present)) return std::move(*motion);
    state_ = present;
    acceleration_.forget();
    return run(frequency);
  }
  // A motion that fails is none of the branch.
  Motion follow(const State& predicted, const State& last, double frequency, const RmsRange& /*looked_for*/) {
    state_ = predicted;
    if (auto motion = tried(frequency, false, nullptr)) return std::move(*motion);
    state_ = last;
    if (auto motion = tried(frequency, false, nullptr)) return std::move(*motion);
    state_ = last;
    return {};
  }
  BranchMotion motion_at(double frequency, const Motion& motion) {
    return {frequency, motion.rms, motion.settled.multiple * single()};
  }
  static BranchPoint point_at(double frequency, const Motion& motion) { return {frequency, motion.rms}; }

 private:
  std::optional<Motion> tried(double frequency, bool recorded, State* beside) {
    try {
      return run(frequency, recorded, beside);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      return std::nullopt;
    }
  }

  // beside: a state that has to fit as well, where the train is made anew.
  Motion run(double frequency, bool recorded, State* beside) {
    State start = state_;
    const int steps = steps_at(settings_.time, frequency);
    try {
      for (;;) {
        Motion motion;
        if (acceleration_.widenings != widenings_) acceleration_ = {{}, widenings_};
        if (const auto found =
                rig_.settle(state_, frequency, steps, settings_.time.steady_state, &acceleration_.columns))
          motion.settled = *found;
        if (motion.settled.turns > 0 && record(recorded, motion)) return motion;
        std::vector<State*> states = states_();
        states.push_back(&start);
        if (beside) states.push_back(beside);
        rig_.widen(states);
        ++widenings_;
        state_ = start;
      }
    } catch (const Error& error) {
      fail_as(error, "at a mesh frequency of ", frequency, " Hz, ", error.what());
    }
  }

  // False if contact leaves the tip edges that are looked at.
  bool record(bool whole, Motion& motion) {
    const int hunting = single();
    const int periods = hunting * (motion.settled.multiple > 0 ? motion.settled.multiple
                                   : hunting > 1               ? 1
                                                               : Recurrence<VectorXd>::kMostMultiple);
    MotionStatistics statistics;
    SystemEnergyBalance energy;
    SystemDynamics::Period period;
    if (whole) begin(periods, motion);
    for (int n = 0; n < periods; ++n) {
      if (!rig_.train().dynamics().integrate(state_, period, whole ? &energy : nullptr)) return false;
      statistics.take(period);
      if (!whole) continue;
      take_samples(period, n, motion);
      take_face(period, motion);
      take(energy, motion);
      take_holding(period, static_cast<double>(periods), motion);
      motion.imbalance += energy.imbalance;
      motion.drift_force = std::max(motion.drift_force, period.drift_force);
      motion.least_gap = std::min(motion.least_gap, period.least_gap);
      motion.least_force = std::min(motion.least_force, period.least_force);
      motion.friction_coupling = std::max(motion.friction_coupling, period.friction_coupling);
    }
    motion.rms = statistics.dte_rms().norm();
    if (whole) take_losses(periods, motion);
    return true;
  }

  void begin(int periods, Motion& motion) {
    const Index samples = static_cast<Index>(periods) * settings_.time.steps_per_period,
                meshes = static_cast<Index>(settings_.layout.meshes.size()),
                bodies = static_cast<Index>(settings_.layout.bodies.size());
    for (MatrixRM* x : {&motion.transmission_error, &motion.mesh_deflection, &motion.mesh_force})
      x->setZero(samples, meshes);
    motion.tooth_load.setZero(samples, meshes * rig_.train().dynamics().tooth_pairs());
    motion.first_pair = rig_.train().dynamics().first_pair();
    motion.bearing_force.assign(static_cast<size_t>(bodies), MatrixRM::Zero(samples, 2));
    motion.energy.setZero(static_cast<Index>(kEnergyLines.size()));
    motion.rolling.setZero(meshes);
    motion.friction.setZero(meshes);
    for (Eigen::RowVectorXd* x : {&motion.bearing_damping, &motion.holding_torque}) x->setZero(bodies);
  }

  // Of recorded mesh period k. Sample 0 is that of the last period's end.
  void take_samples(const SystemDynamics::Period& period, int k, Motion& motion) {
    const Index samples = settings_.time.steps_per_period, stride = period.mesh_force.cols() / samples;
    const auto put = [&](const auto& of, MatrixRM& rows) {
      for (Index i = 1; i <= samples; ++i)
        rows.row((k * samples + i) % rows.rows()) = of.col(i % samples * stride).transpose();
    };
    put(period.transmission_error, motion.transmission_error);
    put(period.mesh_deflection, motion.mesh_deflection);
    put(period.mesh_force, motion.mesh_force);
    take_loads(k, stride, motion);
    for (size_t b = 0; b < period.bearing_force.size(); ++b)
      put(period.bearing_force[b], motion.bearing_force[b]);
  }

  static void take_face(const SystemDynamics::Period& period, Motion& motion) {
    motion.face.resize(period.face.size());
    for (size_t m = 0; m < motion.face.size(); ++m) {
      SystemDynamics::FacePeak peak = period.face[m], &most = motion.face[m];
      peak.line_load = std::max(peak.line_load, most.line_load);
      if (most.tooth_load > peak.tooth_load) {
        peak.tooth_load = most.tooth_load;
        peak.load_factor = most.load_factor;
      }
      most = peak;
    }
  }

  // Pairs are numbered as at rest, from the reference pair of the mesh's own period; in the dynamics by the period of the system. The end
  // of a mesh period is the start of the next one, in which a pair has a number that is higher by one.
  void take_loads(int k, Index stride, Motion& motion) {
    const SystemDynamics& dynamics = rig_.train().dynamics();
    const Index samples = settings_.time.steps_per_period, pairs = dynamics.tooth_pairs();
    for (Index i = 1; i <= samples; ++i) {
      const auto forces = dynamics.tooth_forces().row(i * stride);
      auto row = motion.tooth_load.row((k * samples + i) % motion.tooth_load.rows());
      const double phase = static_cast<double>(i % samples) / static_cast<double>(samples);
      for (int m = 0; m < dynamics.meshes(); ++m) {
        const int later = static_cast<int>(i / samples) + mesh_instant(dynamics.system(), m, phase, 0).period;
        for (Index pair = 0; pair + later < pairs; ++pair)
          row[m * pairs + pair + later] = forces[m * pairs + pair];
      }
    }
  }

  // Mean over the recorded periods of the torques that hold bodies; of a carrier -sum (P - C) x F of its pins, as at rest.
  void take_holding(const SystemDynamics::Period& period, double periods, Motion& motion) const {
    const System& layout = settings_.layout;
    for (size_t b = 0; b < layout.bodies.size(); ++b)
      if (layout.held(static_cast<int>(b)) && layout.bodies[b].kind == System::BodyKind::gear)
        motion.holding_torque[static_cast<Index>(b)] +=
            period.contact_torque.row(static_cast<Index>(b)).mean() / periods;
    for (size_t b = 0; b < layout.bodies.size(); ++b) {
      const System::Body& body = layout.bodies[b];
      if (body.on == System::kGround || !layout.held(body.on)) continue;
      const System::Body& carrier = layout.bodies[static_cast<size_t>(body.on)];
      const double x = body.centre[0] - carrier.centre[0], y = body.centre[1] - carrier.centre[1];
      const Vec2 pin = period.bearing_force[b].rowwise().mean();
      motion.holding_torque[body.on] -= carrier.sense * (x * pin.y() - y * pin.x()) / periods;
    }
  }

  static void take(const SystemEnergyBalance& e, Motion& motion) {
    Eigen::RowVectorXd lines(motion.energy.size());
    lines << e.kinetic, e.modal, e.residual, e.local, e.drive.sum(), e.rolling.sum(), e.friction_rolling,
        e.centrifugal + e.dragging.sum(), e.modal_damping, e.bearing_damping.sum(), e.relaxation_damping,
        e.friction.sum(), e.switching.sum(), e.cutting.sum(), e.averaging, e.dropped,
        e.throughput;  // kEnergyLines
    motion.energy += lines;
    motion.rolling += e.rolling;
    motion.friction += e.friction;
    motion.bearing_damping.head(e.bearing_damping.size()) += e.bearing_damping;
  }

  // What friction takes, and the power that drives, and what holds bodies that turn on the ground, put in.
  void take_losses(int periods, Motion& motion) {
    const SystemDynamics& dynamics = rig_.train().dynamics();
    const double all = motion.friction.sum();
    if (!(all > 0)) return;
    const System& layout = settings_.layout;
    motion.coefficient = motion.friction.dot(dynamics.friction()) / all;
    motion.friction_power = all * dynamics.mesh_frequency() / periods;
    for (int b = 0; b < static_cast<int>(layout.bodies.size()); ++b) {
      if (layout.bodies[static_cast<size_t>(b)].on != System::kGround) continue;
      const double torque = layout.held(b) ? motion.holding_torque[b] : dynamics.torque(b),
                   turning = 2 * std::numbers::pi * dynamics.mesh_frequency() * ground_turns(layout, b);
      motion.power_in += std::max(0.0, torque * turning);
    }
  }

  const SystemSweepParameters& settings_;
  TrainRig rig_;
  State state_;
  Acceleration acceleration_;
  int widenings_ = 0;
  std::function<std::vector<State*>()> states_ = [] { return std::vector<State*>(); };
};

// A motion into its row, but for the loads of its teeth; the note that the sweep reports of it.
std::string store(TrainMotion& motion, Index row, SweepResult& out) {
  const auto at = static_cast<size_t>(row);
  out.transmission_error[at] = std::move(motion.transmission_error);
  out.mesh_deflection[at] = std::move(motion.mesh_deflection);
  out.mesh_force[at] = std::move(motion.mesh_force);
  for (size_t b = 0; b < out.bearing_force.size(); ++b)
    out.bearing_force[b][at] = std::move(motion.bearing_force[b]);
  for (size_t m = 0; m < motion.face.size(); ++m) {
    out.face_load_factor(row, static_cast<Index>(m)) = motion.face[m].load_factor;
    out.line_load_max(row, static_cast<Index>(m)) = motion.face[m].line_load;
  }
  out.energy.row(row) = motion.energy;
  out.rolling.row(row) = motion.rolling;
  out.bearing_damping.row(row) = motion.bearing_damping;
  out.holding_torque.row(row) = motion.holding_torque;
  out.drift_force[row] = motion.drift_force;
  if (out.friction.power.size() > 0) {
    out.friction.coefficient[row] = motion.coefficient;
    out.friction.power[row] = motion.friction_power;
    out.friction.efficiency[row] = motion.power_in > 0 ? 1 - motion.friction_power / motion.power_in : 0;
  }
  out.periods[row] = motion.settled.turns * out.hunting_periods;
  out.period_multiple[row] = motion.settled.multiple * out.hunting_periods;
  out.residual[row] = motion.settled.residual;
  out.energy_imbalance[row] = motion.imbalance / motion.energy[energy_line("throughput")];
  out.least_gap = std::min(out.least_gap, motion.least_gap);
  out.least_force = std::min(out.least_force, motion.least_force);
  out.friction_coupling = std::max(out.friction_coupling, motion.friction_coupling);
  return text(out.periods[row], " periods",
              motion.settled.multiple == 0  ? ", not periodic"
              : motion.settled.multiple > 1 ? text(", repeats after ", out.period_multiple[row])
                                            : "");
}

// All samples are kept until the sweep is written.
void require_memory_for(const SystemSweepParameters& settings, int hunting, size_t speeds) {
  constexpr double kMostMemory =
      4e9;  // bytes; of a mesh three quantities, five pairs in reach, two sides of roots
  const double memory = 8.0 * static_cast<double>(speeds) * hunting * settings.time.steps_per_period *
                        (10.0 * static_cast<double>(settings.layout.meshes.size()) +
                         2.0 * static_cast<double>(settings.layout.bodies.size()));
  if (memory > kMostMemory)
    fail(Failure::input,
         hunting > 1 ? text("the same teeth meet again after ", hunting, " mesh periods; ") : "",
         "the samples of ", speeds, " speeds need ", memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period",
         hunting > 1 ? ", or give errors to fewer gears" : "");
  log_memory(text("the samples of ", speeds, " speeds"), memory);
}

// What the dynamics of a speed had in reach: loads (sample, mesh and within it pair) and the number of the first pair.
struct ToothLoads {
  MatrixRM rows;
  int first = 0;
};

// Loads of all speeds on one axis: from the first pair that carries load, the reference pair or before, to the last.
void store_tooth_loads(std::vector<ToothLoads>&& speeds, SweepResult& out) {
  const Index meshes = out.meshes();
  int first = 0, last = 0;
  for (const ToothLoads& own : speeds)
    for (Index slot = 0; slot < own.rows.cols(); ++slot)
      if (const int pair = own.first + static_cast<int>(slot % (own.rows.cols() / meshes));
          (pair < first || pair > last) && own.rows.col(slot).maxCoeff() > 0) {
        first = std::min(first, pair);
        last = std::max(last, pair);
      }
  out.pair = Eigen::VectorXi::LinSpaced(last - first + 1, first, last);
  for (ToothLoads& own : speeds) {
    const Index pairs = own.rows.cols() / meshes, count = out.pair.size();
    MatrixRM& loads = out.tooth_load.emplace_back(MatrixRM::Zero(own.rows.rows(), meshes * count));
    for (Index m = 0; m < meshes; ++m)
      for (Index p = 0; p < pairs; ++p)
        if (const Index to = own.first + p - first; to >= 0 && to < count)
          loads.col(m * count + to) = own.rows.col(m * pairs + p);
    own.rows.resize(0, 0);
  }
}

// Motions of fewer mesh periods than the longest one repeat.
void fill_rows(SweepResult& a) {
  Index longest = 0;
  for (const MatrixRM& rows : a.transmission_error) longest = std::max(longest, rows.rows());
  const auto fill = [&](std::vector<MatrixRM>& of_speeds) {
    for (MatrixRM& rows : of_speeds) {
      const Index own = rows.rows();
      rows.conservativeResize(longest, rows.cols());
      for (Index i = own; i < longest; ++i) rows.row(i) = rows.row(i - own);
    }
  };
  for (auto* x : {&a.transmission_error, &a.mesh_deflection, &a.mesh_force, &a.tooth_load}) fill(*x);
  for (auto& of_body : a.bearing_force) fill(of_body);
}

// The train of a sweep and rows for its speeds.
SweepResult empty_sweep(const TrainInMotion& rig, const std::vector<double>& speeds) {
  SweepResult out;
  static_cast<MotionSource&>(out) = rig.source();
  const auto n = static_cast<Index>(speeds.size());
  const Index meshes = out.meshes(), bodies = out.bodies();
  out.mesh_frequency = Eigen::Map<const VectorXd>(speeds.data(), n);
  out.rolling.setZero(n, meshes);
  for (MatrixRM* x : {&out.bearing_damping, &out.holding_torque}) x->setZero(n, bodies);
  if (out.train.fidelity.width != WidthModel::one)
    for (MatrixRM* x : {&out.face_load_factor, &out.line_load_max}) x->setZero(n, meshes);
  out.energy.setZero(n, static_cast<Index>(kEnergyLines.size()));
  for (VectorXd* x : {&out.residual, &out.energy_imbalance, &out.drift_force}) x->setZero(n);
  if (out.train.friction().acts())
    for (VectorXd* x : {&out.friction.coefficient, &out.friction.power, &out.friction.efficiency})
      x->setZero(n);
  out.periods.setZero(n);
  out.period_multiple.setZero(n);
  for (auto* x : {&out.transmission_error, &out.mesh_deflection, &out.mesh_force}) x->resize(speeds.size());
  out.bearing_force.assign(static_cast<size_t>(bodies), std::vector<MatrixRM>(speeds.size()));
  return out;
}

}  // namespace

SweepResult system_sweep(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                         Direction direction,
                         const std::function<void(long, long, const std::string&)>& report,
                         double jump_width) {
  const std::vector<double> speeds =
      swept_speeds(settings.frequency_from, settings.frequency_to, settings.frequency_step, direction);
  require_jump_width(jump_width);
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  report(0, static_cast<long>(speeds.size()), "at rest");
  TrainSweepRig moving(settings, bodies);
  require_memory_for(settings, moving.single(), speeds.size());
  SweepResult out = empty_sweep(moving.train(), speeds);
  out.direction = direction;
  out.hunting_periods = moving.single();
  std::vector<ToothLoads> loads;
  loads.reserve(speeds.size());
  SpeedSweep<TrainSweepRig> sweep(moving, settings.time.steady_state);
  sweep.run(speeds, report, [&](long i, TrainMotion&& motion) {
    loads.push_back({std::move(motion.tooth_load), motion.first_pair});
    return store(motion, i, out);
  });
  store_tooth_loads(std::move(loads), out);
  fill_rows(out);
  add_root_stress(moving.train().system(), out);
  store_jumps(sweep.jumps(jump_width, nullptr, report), out.jump_frequency, out.jump_width);
  out.remarks = remarks_on_carriers(out, bodies);
  return out;
}

}  // namespace whine
