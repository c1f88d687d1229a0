#include "studies/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/model_range.h"
#include "dynamics/lines_motion.h"
#include "gear/pair.h"
#include "studies/motion_root_stress.h"
#include "studies/pair_in_motion.h"
#include "studies/speed_sweep.h"
#include "studies/turning_carrier.h"

namespace whine {

using Eigen::Index;
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

// A motion from speed to speed, on the least candidate contacts that hold it; the rig of a SpeedSweep.
class MotionRig {
 public:
  using State = MotionState;
  using Motion = MotionRecord;
  using Acceleration = MotionAcceleration;

  MotionRig(whine::Motion& motion, const TimeDiscretisation& time)
      : motion_(motion), time_(time), state_(motion.rest()) {}

  int single() const { return motion_.hunting_periods(); }
  bool finds_jumps() const { return motion_.system().mesh.size() == 1 || single() == 1; }
  void watch(std::function<std::vector<State*>()> states) { states_ = std::move(states); }
  const State& state() const { return state_; }
  Acceleration& acceleration() { return acceleration_; }

  MotionRecord run(double frequency) { return run(frequency, {}, nullptr); }
  MotionRecord run_from(const State& predicted, double frequency) {
    State present = std::exchange(state_, predicted);
    const int level = motion_.level();
    if (auto found = tried(frequency, {}, &present)) return std::move(*found);
    state_ = present;
    motion_.restore(level);
    acceleration_.forget();
    return run(frequency);
  }
  // A motion that fails is none of the branch.
  MotionRecord follow(const State& predicted, const State& last, double frequency,
                      const RmsRange& looked_for) {
    const int level = motion_.level();
    state_ = predicted;
    for (int trial = 0; trial < 2; ++trial) {
      if (auto found = tried(frequency, looked_for, nullptr)) return std::move(*found);
      state_ = last;
      motion_.restore(level);
    }
    return {};
  }
  State predicted(const std::vector<KnownOrbit<State>>& known, double frequency) {
    return motion_.predicted(known, frequency, steps_at(time_, frequency));
  }
  static BranchMotion motion_at(double frequency, const MotionRecord& found) {
    return {frequency, found.rms, found.multiple};
  }
  static BranchPoint point_at(double frequency, const MotionRecord& found) {
    BranchPoint point{frequency, found.rms, 0, 0, false};
    for (const MotionPeriod& period : found.record) {
      point.tooth_load_max = std::max(point.tooth_load_max, period.tooth_load.maxCoeff());
      point.sustained_load =
          std::max(point.sustained_load, sustained_load(period.tooth_load.transpose(), period.steps()));
      point.parted = point.parted || !(period.mesh_force.minCoeff() > 0);
    }
    return point;
  }

 private:
  std::optional<MotionRecord> settle(double frequency, const RmsRange& looked_for) {
    return motion_.settle(state_, frequency, steps_at(time_, frequency),
                          {time_.periodicity, time_.steady_state, looked_for}, &acceleration_);
  }

  std::optional<MotionRecord> tried(double frequency, const RmsRange& looked_for, State* beside) {
    try {
      return run(frequency, looked_for, beside);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      return std::nullopt;
    }
  }

  // beside: a state that has to fit as well, where there are more candidates.
  MotionRecord run(double frequency, const RmsRange& looked_for, State* beside) {
    State start = state_;
    try {
      for (;;) {
        if (auto found = settle(frequency, looked_for)) return on_lowest_level(frequency, std::move(*found));
        std::vector<State*> states = states_();
        states.push_back(&start);
        if (beside) states.push_back(beside);
        motion_.widen(states);
        state_ = start;
      }
    } catch (const Error& error) {
      fail_as(error, "at ", frequency, " Hz, ", error.what());
    }
  }

  // A transient may have wanted more than the orbit does.
  MotionRecord on_lowest_level(double frequency, MotionRecord found) {
    while (found.multiple > 0) {
      const State reached = state_;
      const int level = motion_.level();
      if (!motion_.narrow()) break;
      std::optional<MotionRecord> lower;
      try {
        lower = settle(frequency, {});
      } catch (const Error& error) {  // the orbit on the level above stands
        if (error.kind() != Failure::numerical) throw;
      }
      if (!lower || lower->multiple != found.multiple) {
        state_ = reached;
        motion_.restore(level);
        break;
      }
      lower->periods += found.periods;
      found = std::move(*lower);
    }
    return found;
  }

  whine::Motion& motion_;
  const TimeDiscretisation& time_;
  State state_;
  Acceleration acceleration_;
  std::function<std::vector<State*>()> states_ = [] { return std::vector<State*>(); };
};

// All samples, and the state that each speed ended with, are kept until the sweep is written.
void require_memory(const SweepResult& a, Index speeds, int samples, const MotionState& state) {
  constexpr double kMostMemory =
      4e9;  // bytes; of a mesh three quantities, five pairs in reach, two sides of roots
  const double numbers = 2 * static_cast<double>(std::visit([](const auto& s) { return s.z.size(); }, state));
  const double memory =
      8.0 * static_cast<double>(speeds) *
      (numbers + static_cast<double>(a.hunting_periods) * samples *
                     (10.0 * static_cast<double>(a.meshes()) + 2.0 * static_cast<double>(a.bodies())));
  if (memory > kMostMemory)
    fail(Failure::input,
         a.hunting_periods > 1
             ? text("the same teeth meet again after ", a.hunting_periods, " mesh periods; ")
             : "",
         "the samples of ", speeds, " speeds need ", memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; give fewer mesh_frequency_Hz, or lower steps_per_period",
         a.hunting_periods > 1 ? ", or give errors to fewer gears" : "");
  log_memory(text("the samples of ", speeds, " speeds"), memory);
}

// What the dynamics of a speed had in reach: loads (sample, mesh and within it pair) and the number of the first pair.
struct ToothLoads {
  MatrixRM rows;
  int first = 0;
};

// Loads of all speeds on one axis: up to |pair| = reach; without one from the first pair that carries load, the reference pair or before, to
// the last.
void store_tooth_loads(std::vector<ToothLoads>&& speeds, int reach, SweepResult& out) {
  const Index meshes = out.meshes();
  int first = -std::max(0, reach), last = std::max(0, reach);
  for (const ToothLoads& own : speeds)
    for (Index slot = 0; slot < own.rows.cols(); ++slot)
      if (const int pair = own.first + static_cast<int>(slot % (own.rows.cols() / meshes));
          reach < 0 && (pair < first || pair > last) && own.rows.col(slot).maxCoeff() > 0) {
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

// Rows for the speeds.
void size_rows(const std::vector<double>& speeds, const SystemModel& system, SweepResult& out) {
  const auto n = static_cast<Index>(speeds.size());
  const Index meshes = out.meshes(), bodies = out.bodies();
  out.mesh_frequency = Eigen::Map<const VectorXd>(speeds.data(), n);
  if (out.of_train()) {
    out.rolling.setZero(n, meshes);
    for (MatrixRM* x : {&out.bearing_damping, &out.holding_torque}) x->setZero(n, bodies);
    out.mesh_deflection.resize(speeds.size());
  }
  if (!system.face.empty())
    for (MatrixRM* x : {&out.face_load_factor, &out.line_load_max}) x->setZero(n, meshes);
  out.energy.setZero(n, static_cast<Index>(kEnergyLines.size()));
  for (VectorXd* x : {&out.residual, &out.energy_imbalance, &out.drift_force}) x->setZero(n);
  if (std::any_of(system.mesh.begin(), system.mesh.end(),
                  [](const GearMeshModel& mesh) { return mesh.friction.acts(); }))
    for (VectorXd* x : {&out.friction.coefficient, &out.friction.power, &out.friction.efficiency})
      x->setZero(n);
  out.periods.setZero(n);
  out.period_multiple.setZero(n);
  for (auto* x : {&out.transmission_error, &out.mesh_force}) x->resize(speeds.size());
  out.bearing_force.assign(static_cast<size_t>(bodies), {});
  for (size_t b = 0; b < out.bearing_force.size(); ++b)
    if (out.of_train() || out.mesh.bearing[b].elastic()) out.bearing_force[b].resize(speeds.size());
}

// The samples of a motion. Pairs are numbered as at rest, from the reference pair of the mesh's own period; in the dynamics by the period of
// the system.
ToothLoads store_samples(const SystemModel& system, const MotionRecord& motion, size_t row,
                         SweepResult& out) {
  const Index samples = out.time.steps_per_period, meshes = out.meshes();
  const auto rows = static_cast<Index>(motion.record.size()) * samples;
  const auto every = [&](const auto& rows_of) {
    MatrixRM all;
    for (size_t k = 0; k < motion.record.size(); ++k) {
      const MotionPeriod& period = motion.record[k];
      const Index stride = period.steps() / samples;
      const auto& own = rows_of(period);
      if (k == 0) all.setZero(rows, own.rows());
      for (Index i = 0; i < samples; ++i)
        all.row(static_cast<Index>(k) * samples + i) = own.col(i * stride).transpose();
    }
    return all;
  };
  out.transmission_error[row] = every([](const MotionPeriod& p) -> auto& { return p.transmission_error; });
  out.mesh_force[row] = every([](const MotionPeriod& p) -> auto& { return p.mesh_force; });
  if (!out.mesh_deflection.empty())
    out.mesh_deflection[row] = every([](const MotionPeriod& p) -> auto& { return p.mesh_deflection; });
  for (size_t b = 0; b < out.bearing_force.size(); ++b)
    if (!out.bearing_force[b].empty())
      out.bearing_force[b][row] = every([b](const MotionPeriod& p) -> auto& { return p.bearing_force[b]; });
  ToothLoads loads{every([](const MotionPeriod& p) -> auto& { return p.tooth_load; }),
                   motion.record[0].first_pair};
  const Index pairs = motion.record[0].pairs();
  for (Index m = 0; m < meshes; ++m)
    for (Index i = 0; i < rows; ++i) {
      const double phase = static_cast<double>(i % samples) / static_cast<double>(samples);
      auto own = loads.rows.row(i).segment(m * pairs, pairs);
      for (int later = mesh_instant(system, static_cast<int>(m), phase, 0).period; later > 0; --later) {
        for (Index pair = pairs - 1; pair > 0; --pair) own[pair] = own[pair - 1];
        own[0] = 0;
      }
    }
  return loads;
}

// A motion into its row, but for its samples; the note that the sweep reports of it.
std::string store(const MotionRecord& motion, Index row, SweepResult& out) {
  const EnergyBalance& energy = motion.energy;
  out.periods[row] = motion.periods;
  out.period_multiple[row] = motion.multiple;
  out.residual[row] = motion.residual;
  out.energy.row(row) = energy.lines();
  out.energy_imbalance[row] = energy.imbalance / energy.throughput;
  if (out.of_train()) {
    out.rolling.row(row) = energy.rolling.transpose();
    out.bearing_damping.row(row).head(energy.bearing_damping.size()) = energy.bearing_damping.transpose();
    out.holding_torque.row(row) = motion.holding_torque;
  }
  std::vector<FacePeak> face(motion.record[0].face.size());
  for (const MotionPeriod& period : motion.record) {
    out.drift_force[row] = std::max(out.drift_force[row], period.drift_force);
    out.least_gap = std::min(out.least_gap, period.least_gap);
    out.least_force = std::min(out.least_force, period.least_force);
    out.fallbacks += period.fallbacks;
    out.friction_coupling = std::max(out.friction_coupling, period.friction_coupling);
    for (size_t m = 0; m < face.size(); ++m) {
      const double line_load = std::max(face[m].line_load, period.face[m].line_load);
      if (period.face[m].tooth_load > face[m].tooth_load) face[m] = period.face[m];
      face[m].line_load = line_load;
    }
  }
  for (size_t m = 0; m < face.size(); ++m) {
    out.face_load_factor(row, static_cast<Index>(m)) = face[m].load_factor;
    out.line_load_max(row, static_cast<Index>(m)) = face[m].line_load;
  }
  if (out.friction.power.size() > 0 && motion.coefficient.size() > 0) {
    const double all = energy.friction.sum();
    out.friction.coefficient[row] =
        out.meshes() == 1 ? motion.coefficient[0] : energy.friction.dot(motion.coefficient) / all;
    out.friction.power[row] = all * out.mesh_frequency[row] / static_cast<double>(motion.record.size());
    out.friction.efficiency[row] = motion.power_in > 0 ? 1 - out.friction.power[row] / motion.power_in : 0;
  }
  return text(motion.periods, " periods",
              motion.multiple == 0                    ? ", not periodic"
              : motion.multiple > out.hunting_periods ? text(", repeats after ", motion.multiple)
                                                      : "");
}

struct SweepPlan {
  const std::vector<double>& speeds;
  const std::function<void(long, long, const std::string&)>& report;
  std::vector<BranchPoint>* left_early;
  double jump_width;
};

// `out` has what is moved and the direction. Returns m: the least transmission error of all steps.
double swept(Motion& motion, const SweepPlan& plan, SweepResult& out) {
  const SystemModel& system = motion.system();
  const TimeDiscretisation& time = out.time;
  MotionRig rig(motion, time);
  out.hunting_periods = motion.hunting_periods();
  require_memory(out, static_cast<Index>(plan.speeds.size()), time.steps_per_period, rig.state());
  size_rows(plan.speeds, system, out);
  std::vector<ToothLoads> loads;
  loads.reserve(plan.speeds.size());
  double least_error = std::numeric_limits<double>::infinity();
  SpeedSweep<MotionRig> sweep(rig, time.steady_state);
  sweep.run(plan.speeds, plan.report, [&](long i, MotionRecord&& found) {
    loads.push_back(store_samples(system, found, static_cast<size_t>(i), out));
    for (const MotionPeriod& period : found.record)
      least_error = std::min(least_error, period.transmission_error.minCoeff());
    return store(found, i, out);
  });
  store_jumps(sweep.jumps(plan.jump_width, plan.left_early, plan.report), out.jump_frequency, out.jump_width);
  store_tooth_loads(std::move(loads), out.of_train() || !system.face.empty() ? -1 : motion.reach(), out);
  if (!out.of_train())
    for (size_t i = 0; i < plan.speeds.size(); ++i) out.mesh_force[i] = out.tooth_load[i].rowwise().sum();
  fill_rows(out);
  add_root_stress(system, out);
  return least_error;
}

}  // namespace

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
  const std::vector<double> speeds = swept_speeds(settings, direction);
  require_jump_width(jump_width);
  report(0, static_cast<long>(speeds.size()), "at rest");
  const PairInMotion pair(driver, driven, statics, mean_stiffness, settings);
  SweepResult out;
  pair.describe(out);
  out.direction = direction;
  double least_error = swept(*pair.motion, {speeds, report, left_early, jump_width}, out);
  if (out.mesh.on_bearings()) least_error = least_closing(out).minCoeff();
  out.backlash_margin = out.tooth_thinning() > 0 ? GearPair(out).backlash() + least_error
                                                 : std::numeric_limits<double>::infinity();
  out.backlash_left = backlash_left(out);
  out.remarks = remarks(out, statics);
  return out;
}

SweepResult system_sweep(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                         Direction direction,
                         const std::function<void(long, long, const std::string&)>& report,
                         double jump_width) {
  const std::vector<double> speeds = swept_speeds(settings, direction);
  require_jump_width(jump_width);
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  report(0, static_cast<long>(speeds.size()), "at rest");
  LinesMotion motion(settings, bodies, steps_at(settings.time, settings.frequency_from));
  SweepResult out;
  static_cast<MotionSource&>(out) = motion.source();
  out.section = settings.section;
  out.errors = settings.errors;
  out.direction = direction;
  swept(motion, {speeds, report, nullptr, jump_width}, out);
  // Said once of a pair of sweeps, as those of a pair of gears are.
  if (direction == Direction::up) out.remarks = remarks_on_carriers(out, settings, bodies);
  return out;
}

}  // namespace whine
