#include "studies/runup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/steady_state.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "signal/branches.h"
#include "signal/uniform_sampler.h"
#include "studies/sustained_peaks.h"
#include "studies/sweep.h"
#include "studies/zone_levels.h"

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
  Runner(const GearMeshModel& model, const StaticResult& statics, const SweepParameters& settings,
         const RunupSettings& wanted, RunupResult& head, RunupSink& sink,
         const std::function<void(long, long, const std::string&)>& report)
      : model_(model),
        settings_(settings),
        wanted_(wanted),
        clock_(wanted.ramp, head.mesh_acceleration),
        head_(head),
        sink_(sink),
        report_(report),
        levels_(model,
                dynamic_parameters(statics, head.mean_stiffness, settings,
                                   std::max(wanted.ramp.from, wanted.ramp.to)),
                statics, steps_at(settings.time, std::min(wanted.ramp.from, wanted.ramp.to))),
        peaks_(model, settings.time.steps_per_period) {
    head.root_stress = peaks_.root_stress();
  }

  void run() {
    begin();
    settle();
    const double margin = (UniformSampler::kHalfWidth + 1) / wanted_.sample_rate;
    SpeedBlock block = block_at(-(static_cast<long>(std::ceil(margin * wanted_.ramp.from)) + 1));
    for (int before = block.steps; !sampler_->complete();) {
      const SpeedBlock next = block_at(block.end());
      for (long k = block.first; k < block.end(); ++k) {
        const int own_next = k + 1 == block.end() ? next.steps : block.steps;
        integrate(k, block);
        record(k, block.steps, k == block.first ? before : block.steps, own_next);
      }
      before = block.steps;
      block = next;
      hand_on(false);
    }
    hand_on(true);
    head_.backlash_margin = head_.tooth_thinning() > 0 ? model_.kinematics.backlash() + least_closing_
                                                       : std::numeric_limits<double>::infinity();
    sink_.end(head_);
  }

 private:
  // Level 0 tells the pairs that can touch; a wider zone may reach one more on either side.
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
    levels_.at(0);
    reach_ = levels_.reach() + 1;
    head_.natural_frequency = levels_.natural_frequency();
    head_.pair = Eigen::VectorXi::LinSpaced(2 * reach_ + 1, -reach_, reach_);
    for (size_t g = 0; g < kSides; ++g) {
      head_.bearing_damper[g] = levels_.at(0).bearing_damper(static_cast<int>(g));
      floating_ += head_.mesh.bearing[g].elastic();
    }
    channels_ = 2 + 2 * reach_ + 1 + 2 * floating_;
    sampler_.emplace(wanted_.sample_rate, samples_, channels_);
    sink_.begin(head_, samples_, periods_);
    row_.resize(static_cast<size_t>(channels_));
  }

  // The largest block from period k on within which the speed changes by no more than it may.
  SpeedBlock block_at(long k) const {
    constexpr double kMost = 64;
    const double f = clock_.frequency(clock_.time(static_cast<double>(k)));
    const double most = wanted_.speed_change * f * f / std::abs(head_.mesh_acceleration);
    return {k, static_cast<int>(std::clamp(most, 1.0, kMost)), steps_at(settings_.time, f)};
  }

  // The periodic motion at the start of the ramp. Without one the record would begin with a transient of no known cause.
  void settle() {
    for (;; ++level_) {
      levels_.require(level_, wanted_.ramp.from);
      RollingDynamics& dynamics = levels_.at(level_);
      state_ = dynamics.rest();
      dynamics.set_speed(wanted_.ramp.from, steps_at(settings_.time, wanted_.ramp.from));
      const auto orbit =
          iterate_to_orbit(dynamics, state_, settings_.time.periodicity, settings_.time.steady_state);
      if (!orbit) continue;
      if (orbit->multiple == 0)
        fail(Failure::numerical, "no periodic motion is found at ", wanted_.ramp.from,
             " Hz, where the ramp starts: from rest the motion does not repeat to ",
             settings_.time.periodicity,
             "; start at a mesh frequency at which the sweep has a periodic motion (--from, FROM= of make)");
      return;
    }
  }

  void set_block(const SpeedBlock& block) {
    const double start = clock_.time(static_cast<double>(block.first)),
                 end = clock_.time(static_cast<double>(block.end()));
    levels_.at(level_).pass_speed(block.periods / (end - start), block.steps);
  }

  bool try_period() {
    trial_ = state_;
    if (!levels_.at(level_).integrate(trial_, period_)) return false;
    std::swap(state_, trial_);
    return true;
  }

  // One mesh period into period_, on the level of before or a higher one; a lower one is tried now and then.
  void integrate(long k, const SpeedBlock& block) {
    constexpr long kPatience = 64;  // mesh periods on a level before the one below it is tried
    const double at = clock_.frequency(clock_.time(static_cast<double>(k)));
    try {
      if (k == block.first) set_block(block);
      if (level_ > 0 && !levels_.keeps_one() && k - level_since_ >= kPatience) {
        --level_;
        level_since_ = k;
        set_block(block);
        if (try_period()) return;
        ++level_;
        set_block(block);
      }
      while (!try_period()) {
        levels_.require(++level_, at);
        level_since_ = k;
        set_block(block);
      }
    } catch (const Error& error) {
      fail_as(error, "at ", at, " Hz, ", error.what());
    }
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

  // Samples i = 1 to steps of a period; the last one is the first of the next.
  void record(long k, int steps, int before, int after) {
    const VectorXd& error = period_.transmission_error;
    const int own_reach = static_cast<int>(period_.tooth_pair_load.rows()) / 2;
    if (own_reach > reach_)
      fail(Failure::numerical, "pairs up to ", own_reach, " touch, ", reach_, " are foreseen");
    double squares = 0;
    int parted = 0;
    const double mean = error.mean();
    for (int i = 1; i <= steps; ++i) {
      const int at = i % steps;
      const auto loads = period_.tooth_pair_load.col(at);
      const double force = loads.sum();
      std::fill(row_.begin(), row_.end(), 0.0);
      row_[0] = error[at];
      row_[1] = force;
      const long named = i < steps ? k : k + 1;  // the state at the end has the names of the next period
      for (Index j = 0; j < loads.size(); ++j)
        row_[2 + static_cast<size_t>(pair_channel(static_cast<long>(j) - own_reach, named))] = loads[j];
      double closing = error[at];  // without what bearings give way
      size_t next = 2 + 2 * static_cast<size_t>(reach_) + 1;
      for (size_t g = 0; g < kSides; ++g)
        if (head_.mesh.bearing[g].elastic()) {
          for (int xy = 0; xy < 2; ++xy) row_[next++] = period_.bearing_force[g](xy, at);
          closing += (g == 0 ? 1 : -1) / head_.mesh.bearing[g].stiffness *
                     period_.bearing_force[g].col(at).dot(normal_);
        }
      const double w = i < steps ? weight(k, i, steps, before, after) : weight(k + 1, 0, after, steps, after);
      sampler_->push(clock_.time(static_cast<double>(k) + static_cast<double>(i) / steps), w, row_.data());
      squares += (error[at] - mean) * (error[at] - mean);
      least_closing_ = std::min(least_closing_, closing);
      parted += !(force > 0);
    }
    head_.least_gap = std::min(head_.least_gap, period_.least_gap);
    head_.least_force = std::min(head_.least_force, period_.least_force);
    head_.fallbacks += period_.fallbacks;
    head_.drift_force = std::max(head_.drift_force, period_.drift_force);
    if (k < 0 || k >= periods_) return;
    const double start = clock_.time(static_cast<double>(k));
    const double most =
        sustained_load(period_.tooth_pair_load.transpose(), static_cast<int>(period_.tooth_pair_load.cols()));
    const VectorXd peaks = head_.root_stress ? peaks_.of(period_, static_cast<int>(k), SustainedPeaks::kNever)
                                             : VectorXd::Zero(SustainedPeaks::kRows);
    for (const double x : {start, clock_.frequency(start), std::sqrt(squares / steps), mean, most,
                           static_cast<double>(parted) / steps, peaks[2], peaks[3]})
      period_rows_.push_back(x);
  }

  // Whole blocks to the sink, at last what is left.
  void hand_on(bool last) {
    const MatrixRM fresh = sampler_->take();
    sample_rows_.insert(sample_rows_.end(), fresh.data(), fresh.data() + fresh.size());
    constexpr Index kPeriodColumns = 8;
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
    while (const Index n = whole(period_rows_, kPeriodColumns)) {
      const Eigen::Map<const MatrixRM> rows(period_rows_.data(), n, kPeriodColumns);
      RunupPeriods periods{rows.col(0), rows.col(1), rows.col(2), rows.col(3), rows.col(4), rows.col(5)};
      for (size_t g = 0; head_.root_stress && g < kSides; ++g)
        periods.root_stress_sustained[g] = rows.col(6 + static_cast<Index>(g));
      sink_.take(periods);
      drop(period_rows_, n * kPeriodColumns);
    }
  }

  RunupSamples samples_of(const Eigen::Ref<const MatrixRM>& rows) {
    RunupSamples out;
    const Index n = rows.rows();
    out.time = VectorXd::NullaryExpr(
        n, [&](Index i) { return static_cast<double>(first_ + i) / wanted_.sample_rate; });
    out.mesh_frequency = out.time.unaryExpr([&](double t) { return clock_.frequency(t); });
    out.transmission_error = rows.col(0);
    out.mesh_force = rows.col(1);
    out.tooth_load.resize(n, 2 * reach_ + 1);
    for (Index i = 0; i < n; ++i) {
      const auto k = static_cast<long>(std::floor(head_.mesh_phase(out.time[i])));
      for (int number = -reach_; number <= reach_; ++number)
        out.tooth_load(i, reach_ + number) = rows(i, 2 + pair_channel(number, k));
    }
    Index next = 2 + 2 * reach_ + 1;
    for (size_t g = 0; g < kSides; ++g)
      if (head_.mesh.bearing[g].elastic()) {
        out.bearing_force[g] = rows.middleCols(next, 2);
        next += 2;
      }
    first_ += n;
    return out;
  }

  const GearMeshModel& model_;
  const SweepParameters& settings_;
  const RunupSettings& wanted_;
  RampClock clock_;
  RunupResult& head_;
  RunupSink& sink_;
  const std::function<void(long, long, const std::string&)>& report_;
  ZoneLevels levels_;
  SustainedPeaks peaks_;
  Vec2 normal_ = contact_normal(GearPair(head_));
  int level_ = 0, reach_ = 0, channels_ = 0, floating_ = 0;
  long level_since_ = 0;
  Index periods_ = 0, samples_ = 0, first_ = 0;
  RollingDynamics::State state_, trial_;
  RollingDynamics::Period period_;
  std::optional<UniformSampler> sampler_;
  std::vector<double> row_, sample_rows_, period_rows_;
  double least_closing_ = std::numeric_limits<double>::infinity();
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

void runup(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
           double mean_stiffness, const SweepParameters& settings, const RunupSettings& wanted,
           RunupSink& sink, const std::function<void(long, long, const std::string&)>& report) {
  require_ramp(wanted, settings.time);
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
  const GearMeshModel model(driver, driven, statics.mesh);
  RunupResult head;
  set_motion(head, {driver, driven}, statics, settings);
  head.time = settings.time;
  head.torque = statics.torque;
  head.mean_stiffness = mean_stiffness;
  head.direction = wanted.ramp.to > wanted.ramp.from ? Direction::up : Direction::down;
  head.ramp = wanted.ramp;
  head.mesh_acceleration =
      wanted.ramp.rate / 60 * statics.gear[0].design.teeth * (head.direction == Direction::up ? 1 : -1);
  head.sample_rate = wanted.sample_rate;
  Runner(model, statics, settings, wanted, head, sink, report).run();
}

}  // namespace whine
