#include "studies/runup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/error.h"
#include "dynamics/lines_motion.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "signal/branches.h"
#include "signal/uniform_sampler.h"
#include "studies/pair_in_motion.h"
#include "studies/sustained_peaks.h"
#include "studies/sweep.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Mesh frequency, phase and time of a ramp, at constant speed before and after it.
class RampClock {
 public:
  RampClock(const SpeedRamp& ramp, double acceleration)
      : from_(ramp.from),
        to_(ramp.to),
        acceleration_(acceleration),
        end_((ramp.to - ramp.from) / acceleration),
        end_phase_(0.5 * end_ * (ramp.from + ramp.to)) {}

  double end() const { return end_; }              // s
  double end_phase() const { return end_phase_; }  // mesh periods
  double frequency(double t) const { return from_ + acceleration_ * std::clamp(t, 0.0, end_); }  // Hz
  double time(double phase) const {                                                              // s
    if (phase <= 0) return phase / from_;
    if (phase >= end_phase_) return end_ + (phase - end_phase_) / to_;
    return 2 * phase / (from_ + std::sqrt(from_ * from_ + 2 * acceleration_ * phase));
  }

 private:
  double from_, to_, acceleration_, end_, end_phase_;
};

// Mesh periods first to first + periods - 1 at one speed and one number of steps a period.
struct SpeedBlock {
  long first = 0;
  int periods = 1, steps = 1;
  long end() const { return first + periods; }
};

class Runner {
 public:
  // head: says what is moved, and whether pairs up to `reach` are recorded; -1: no loads of pairs are.
  Runner(Motion& motion, int reach, const TimeDiscretisation& time, const RunupSettings& wanted,
         RunupResult& head, RunupSink& sink,
         const std::function<void(long, long, const std::string&)>& report)
      : motion_(motion),
        time_(time),
        wanted_(wanted),
        clock_(wanted.ramp, head.mesh_acceleration),
        head_(head),
        sink_(sink),
        report_(report),
        reach_(reach) {}

  void run() {
    begin();
    // Without a periodic motion the record would begin with a transient of no known cause.
    if (!settle())
      fail(Failure::numerical, "no periodic motion is found at ", wanted_.ramp.from,
           " Hz, where the ramp starts: from rest the motion does not repeat to ", time_.periodicity,
           "; start at a mesh frequency at which the sweep has a periodic motion (--from, FROM= of make)");
    const double margin = (UniformSampler::kHalfWidth + 1) / wanted_.sample_rate;
    SpeedBlock block = block_at(-(static_cast<long>(std::ceil(margin * wanted_.ramp.from)) + 1));
    for (int before = block.steps; !sampler_->complete();) {
      const SpeedBlock next = block_at(block.end());
      for (long k = block.first; k < block.end(); ++k) {
        const int own_next = k + 1 == block.end() ? next.steps : block.steps;
        record(integrated(k, block), k, block.steps, k == block.first ? before : block.steps, own_next);
      }
      before = block.steps;
      block = next;
      hand_on(false);
    }
    hand_on(true);
    head_.backlash_margin = !head_.of_train() && head_.tooth_thinning() > 0
                                ? motion_.system().mesh[0].kinematics.backlash() + least_closing_
                                : std::numeric_limits<double>::infinity();
    sink_.end(head_);
  }

 private:
  void begin() {
    const double samples = std::floor(clock_.end() * wanted_.sample_rate) + 1,
                 periods = std::floor(clock_.end_phase());
    if (!(periods >= 1))
      fail(Failure::input, "the ramp from ", wanted_.ramp.from, " to ", wanted_.ramp.to, " Hz at ",
           wanted_.ramp.rate, " rpm/s takes ", clock_.end(), " s, less than a mesh period; lower the rate");
    constexpr double kMost = 4e8;
    if (!(samples <= kMost && periods <= kMost))
      fail(Failure::input, "the ramp takes ", clock_.end(), " s, which are ", samples, " samples and ",
           periods, " mesh periods, ", kMost, " of each at most; raise the rate");
    samples_ = static_cast<Index>(samples);  // no such number before the limits are checked
    periods_ = static_cast<Index>(periods);
    peaks_ = sustained_peaks(motion_.system(), time_.steps_per_period);
    for (const SustainedPeaks& mesh : peaks_) head_.root_stress |= mesh.root_stress();
    if (reach_ >= 0) head_.pair = Eigen::VectorXi::LinSpaced(2 * reach_ + 1, -reach_, reach_);
    for (size_t b = 0; b < head_.body_names.size(); ++b)
      if (head_.has_bearing(b)) borne_.push_back(b);
    channels_ = 2 * static_cast<int>(head_.meshes()) + static_cast<int>(head_.pair.size()) +
                2 * static_cast<int>(borne_.size());
    period_columns_ = 2 + 4 * head_.meshes() + (head_.root_stress ? kSides * head_.meshes() : 0);
    sampler_.emplace(wanted_.sample_rate, samples_, channels_);
    sink_.begin(head_, samples_, periods_);
    row_.resize(static_cast<size_t>(channels_));
  }

  // The largest block from period k on within which the speed changes by no more than it may.
  SpeedBlock block_at(long k) const {
    constexpr double kMost = 64;
    const double f = clock_.frequency(clock_.time(static_cast<double>(k)));
    const double most = wanted_.speed_change * f * f / std::abs(head_.mesh_acceleration);
    return {k, static_cast<int>(std::clamp(most, 1.0, kMost)), steps_at(time_, f)};
  }

  // From rest; false if the motion does not repeat.
  bool settle() {
    const double f = wanted_.ramp.from;
    try {
      for (;; motion_.widen({})) {
        state_ = motion_.rest();
        if (const auto found = motion_.settle(state_, f, steps_at(time_, f),
                                              {time_.periodicity, time_.steady_state, {}, false}))
          return found->multiple != 0;
      }
    } catch (const Error& error) {
      fail_as(error, "at ", f, " Hz, ", error.what());
    }
  }

  bool try_period() {
    trial_ = state_;
    if (!motion_.integrate(trial_, period_)) return false;
    std::swap(state_, trial_);
    return true;
  }

  // Mesh period k at a speed (Hz) that may be a new one (`fresh`), on the candidate contacts of before or more; fewer are tried now and then.
  void integrate(long k, double mesh_frequency, int steps, bool fresh) {
    constexpr long kPatience = 64;  // mesh periods on a level before the one below it is tried
    const auto widen = [&] {
      motion_.widen({&state_});
      level_since_ = k;
      motion_.pass_speed(mesh_frequency, steps);
    };
    if (fresh) motion_.pass_speed(mesh_frequency, steps);
    if (k - level_since_ >= kPatience && motion_.narrow()) {
      level_since_ = k;
      motion_.pass_speed(mesh_frequency, steps);
      if (try_period()) return;
      widen();
    }
    while (!try_period()) widen();
  }

  const MotionPeriod& integrated(long k, const SpeedBlock& block) {
    const double start = clock_.time(static_cast<double>(block.first)),
                 end = clock_.time(static_cast<double>(block.end()));
    try {
      integrate(k, block.periods / (end - start), block.steps, k == block.first);
      if (!head_.of_train()) least_closing_ = std::min(least_closing_, closing().minCoeff());
      return period_;
    } catch (const Error& error) {
      fail_as(error, "at ", clock_.frequency(clock_.time(static_cast<double>(k))), " Hz, ", error.what());
    }
  }

  // (step) m: of a pair the transmission error without what bearings give way.
  VectorXd closing() const {
    VectorXd out = period_.transmission_error.row(0).transpose();
    const GearMeshModel& mesh = motion_.system().mesh[0];
    for (size_t g = 0; g < kSides; ++g)
      if (const Bearing& bearing = mesh.bearing[g]; bearing.elastic())
        out += (g == 0 ? 1 : -1) / bearing.stiffness *
               (period_.bearing_force[g].transpose() * contact_normal(mesh.kinematics));
    return out;
  }

  // s: weights of the instants i of period k for the trapezoidal rule. Where the number of steps changes, the rules of
  // both are blended over the period of short steps, so that no end of a rule is left within the record.
  double weight(long k, int i, int steps, int before, int after) const {
    const double phase = static_cast<double>(i) / steps;
    const double fine = 1 / (clock_.frequency(clock_.time(static_cast<double>(k) + phase)) * steps);
    const int coarse = std::min(before, after);
    if (coarse >= steps) return fine;
    const int ratio = steps / coarse;
    const double rising = 0.5 - 0.5 * std::cos(std::numbers::pi * phase),
                 share = before < steps ? rising : 1 - rising;  // of the rule of short steps
    return fine * (share + (i % ratio == 0 ? (1 - share) * ratio : 0));
  }

  // Channel of the pair with this number in period k: (number - k) mod (2 reach + 1). A pair's number rises by one from
  // period to period, so each keeps its channel: the filter would ring on the step of a load from one number to another.
  Index pair_channel(long number, long k) const {
    const long pairs = 2 * reach_ + 1, rest = (number - k) % pairs;
    return rest < 0 ? rest + pairs : rest;
  }

  // Channels: transmission errors, mesh forces, forces on bearings, loads of pairs.
  void fill_row(const MotionPeriod& period, Index at, long named) {
    std::fill(row_.begin(), row_.end(), 0.0);
    size_t next = 0;
    for (const Eigen::MatrixXd* of : {&period.transmission_error, &period.mesh_force})
      for (Index m = 0; m < of->rows(); ++m) row_[next++] = (*of)(m, at);
    for (const size_t b : borne_)
      for (int xy = 0; xy < 2; ++xy) row_[next++] = period.bearing_force[b](xy, at);
    for (int j = 0; reach_ >= 0 && j < period.pairs(); ++j)
      row_[next + static_cast<size_t>(pair_channel(period.first_pair + j, named))] = period.tooth_load(j, at);
  }

  // Samples i = 1 to steps of a period; the last one is the first of the next.
  void record(const MotionPeriod& period, long k, int steps, int before, int after) {
    if (reach_ >= 0 && period.pairs() / 2 > reach_)
      fail(Failure::numerical, "pairs up to ", period.pairs() / 2, " touch, ", reach_, " are foreseen");
    for (int i = 1; i <= steps; ++i) {
      // The state at the end has the names of the next period.
      fill_row(period, i % steps, i < steps ? k : k + 1);
      const double w = i < steps ? weight(k, i, steps, before, after) : weight(k + 1, 0, after, steps, after);
      sampler_->push(clock_.time(static_cast<double>(k) + static_cast<double>(i) / steps), w, row_.data());
    }
    head_.least_gap = std::min(head_.least_gap, period.least_gap);
    head_.least_force = std::min(head_.least_force, period.least_force);
    head_.fallbacks += period.fallbacks;
    head_.drift_force = std::max(head_.drift_force, period.drift_force);
    if (k < 0 || k >= periods_) return;
    const double start = clock_.time(static_cast<double>(k));
    const auto put = [&](const VectorXd& x) {
      period_rows_.insert(period_rows_.end(), x.data(), x.data() + x.size());
    };
    const Index meshes = head_.meshes();
    VectorXd rms(meshes), mean(meshes), sustained(meshes), parted(meshes);
    for (Index m = 0; m < meshes; ++m) {
      sustained[m] = sustained_load(period.loads_of(m).transpose(), steps);
      parted[m] = static_cast<double>((period.largest_tooth_force.row(m).array() <= 0).count()) / steps;
      const auto error = period.transmission_error.row(m);
      mean[m] = error.mean();
      double squares = 0;
      for (int i = 1; i <= steps; ++i) squares += (error[i % steps] - mean[m]) * (error[i % steps] - mean[m]);
      rms[m] = std::sqrt(squares / steps);
    }
    put(Eigen::Vector2d(start, clock_.frequency(start)));
    for (const auto& x : {std::cref(rms), std::cref(mean), std::cref(sustained), std::cref(parted)}) put(x);
    if (!head_.root_stress) return;
    for (SustainedPeaks& mesh : peaks_) {
      const VectorXd peaks = mesh.of(period, static_cast<int>(k), SustainedPeaks::kNever);
      put(mesh.root_stress() ? VectorXd(peaks.segment(2, kSides)) : VectorXd::Zero(kSides));
    }
  }

  // Whole blocks to the sink, at last what is left.
  void hand_on(bool last) {
    const MatrixRM fresh = sampler_->take();
    sample_rows_.insert(sample_rows_.end(), fresh.data(), fresh.data() + fresh.size());
    const auto whole = [&](const std::vector<double>& rows, Index columns) {
      const Index count = static_cast<Index>(rows.size()) / columns;
      return last ? std::min(count, kRunupBlock) : count >= kRunupBlock ? kRunupBlock : 0;
    };
    const auto drop = [](std::vector<double>& rows, Index numbers) {
      rows.erase(rows.begin(), rows.begin() + numbers);
    };
    while (const Index n = whole(sample_rows_, channels_)) {
      sink_.take(samples_of(Eigen::Map<const MatrixRM>(sample_rows_.data(), n, channels_)));
      drop(sample_rows_, n * channels_);
      const double t = static_cast<double>(first_) / wanted_.sample_rate;
      report_(first_, samples_, text(t, " s, ", clock_.frequency(t), " Hz"));
    }
    while (const Index n = whole(period_rows_, period_columns_)) {
      const Eigen::Map<const MatrixRM> rows(period_rows_.data(), n, period_columns_);
      RunupPeriods periods{rows.col(0), rows.col(1), {}, {}, {}, {}, {}};
      Index next = 2;
      for (MatrixRM* x :
           {&periods.dte_rms, &periods.dte_mean, &periods.tooth_load_max, &periods.separation_fraction}) {
        *x = rows.middleCols(next, head_.meshes());
        next += head_.meshes();
      }
      if (head_.root_stress) periods.root_stress_sustained = rows.middleCols(next, kSides * head_.meshes());
      sink_.take(periods);
      drop(period_rows_, n * period_columns_);
    }
  }

  RunupSamples samples_of(const Eigen::Ref<const MatrixRM>& rows) {
    RunupSamples out;
    const Index n = rows.rows(), meshes = head_.meshes();
    out.time = VectorXd::NullaryExpr(
        n, [&](Index i) { return static_cast<double>(first_ + i) / wanted_.sample_rate; });
    out.mesh_frequency = out.time.unaryExpr([&](double t) { return clock_.frequency(t); });
    out.transmission_error = rows.leftCols(meshes);
    out.mesh_force = rows.middleCols(meshes, meshes);
    Index next = 2 * meshes;
    out.bearing_force.resize(head_.body_names.size());
    for (const size_t b : borne_) {
      out.bearing_force[b] = rows.middleCols(next, 2);
      next += 2;
    }
    if (reach_ >= 0) out.tooth_load.resize(n, head_.pair.size());
    for (Index i = 0; reach_ >= 0 && i < n; ++i) {
      const auto k = static_cast<long>(std::floor(head_.mesh_phase(out.time[i])));
      for (int number = -reach_; number <= reach_; ++number)
        out.tooth_load(i, reach_ + number) = rows(i, next + pair_channel(number, k));
    }
    first_ += n;
    return out;
  }

  Motion& motion_;
  const TimeDiscretisation& time_;
  const RunupSettings& wanted_;
  RampClock clock_;
  RunupResult& head_;
  RunupSink& sink_;
  const std::function<void(long, long, const std::string&)>& report_;
  int reach_, channels_ = 0;
  MotionState state_, trial_;
  MotionPeriod period_;
  long level_since_ = 0;
  std::vector<SustainedPeaks> peaks_;                               // [mesh]
  double least_closing_ = std::numeric_limits<double>::infinity();  // m
  Index period_columns_ = 0;
  std::vector<size_t> borne_;  // bodies whose force on the bearing is recorded
  Index periods_ = 0, samples_ = 0, first_ = 0;
  std::optional<UniformSampler> sampler_;
  std::vector<double> row_, sample_rows_, period_rows_;
};

void require_ramp(const RunupSettings& wanted, const TimeDiscretisation& time) {
  const SpeedRamp& ramp = wanted.ramp;
  if (!(ramp.from > 0) || !(ramp.to > 0) || ramp.from == ramp.to)
    fail(Failure::input, "the ramp from ", ramp.from, " to ", ramp.to,
         " Hz: both mesh frequencies must be above 0 and differ");
  if (!(ramp.rate > 0) || !std::isfinite(ramp.rate))
    fail(Failure::input, "the speed changes by ", ramp.rate,
         " rpm/s; give a number above 0, whether the speed rises is said by the mesh frequencies");
  for (const double f : {ramp.from, ramp.to})
    if (const double own = f * steps_at(time, f); !(own >= 2 * wanted.sample_rate))
      fail(Failure::input, "at ", f, " Hz the time steps have a rate of ", own, " Hz, less than twice the ",
           wanted.sample_rate, " Hz of the record; raise min_sample_rate_kHz");
}

}  // namespace

std::array<double, kSides> acceleration_torque(const RunupResult& a) {
  std::array<double, kSides> torque;
  for (size_t g = 0; g < kSides; ++g)
    torque[g] = a.inertia[g] * 2 * std::numbers::pi * std::abs(a.mesh_acceleration) / a.gear[g].design.teeth;
  return torque;
}

namespace {

// mesh_periods: in a revolution of the input.
RunupResult head_of(const RunupSettings& wanted, double mesh_periods) {
  RunupResult head;
  head.direction = wanted.ramp.to > wanted.ramp.from ? Direction::up : Direction::down;
  head.ramp = wanted.ramp;
  head.mesh_acceleration = wanted.ramp.rate / 60 * mesh_periods * (head.direction == Direction::up ? 1 : -1);
  head.sample_rate = wanted.sample_rate;
  return head;
}

}  // namespace

void runup(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
           double mean_stiffness, const SweepParameters& settings, const RunupSettings& wanted,
           RunupSink& sink, const std::function<void(long, long, const std::string&)>& report) {
  require_ramp(wanted, settings.time);
  SweepParameters of_ramp = settings;
  of_ramp.frequency_from = std::min(wanted.ramp.from, wanted.ramp.to);
  of_ramp.frequency_to = std::max(wanted.ramp.from, wanted.ramp.to);
  const PairInMotion pair(driver, driven, statics, mean_stiffness, of_ramp);
  RunupResult head = head_of(wanted, statics.gear[0].design.teeth);
  pair.describe(head);
  head.input = statics.mesh.gear[0];
  // With more candidates one more on either side may touch.
  Runner(*pair.motion, pair.motion->reach() + 1, settings.time, wanted, head, sink, report).run();
}

void runup(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
           const RunupSettings& wanted, RunupSink& sink,
           const std::function<void(long, long, const std::string&)>& report) {
  require_ramp(wanted, settings.time);
  const auto input = static_cast<size_t>(input_of(settings.layout));
  RunupResult head = head_of(wanted, 1 / std::abs(train_speeds(settings.layout).turns[input]));
  head.input = settings.layout.bodies[input].name;
  SystemSweepParameters of_ramp = settings;
  of_ramp.frequency_from = std::min(wanted.ramp.from, wanted.ramp.to);
  of_ramp.frequency_to = std::max(wanted.ramp.from, wanted.ramp.to);
  LinesMotion motion(of_ramp, bodies, steps_at(of_ramp.time, of_ramp.frequency_from));
  static_cast<MotionSource&>(head) = motion.source();
  Runner(motion, -1, settings.time, wanted, head, sink, report).run();
}

}  // namespace whine
