#include "studies/pair_branch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "dynamics/period_map.h"
#include "dynamics/steady_state.h"
#include "gear/body_inertia.h"
#include "orbits/branch.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr int kMostLevel = 8;
constexpr int kMultipliers = 8;  // that are kept of each orbit
constexpr int kMostSegments = 64;

CandidateZone zone(const GearMeshModel& model, const StaticArtifact& statics, int level) {
  const auto at = [&](int l) {
    return candidate_zone(model, statics, MotionBounds(model, statics, std::pow(kWidening, l)));
  };
  CandidateZone range = at(level);
  if (level == 0) return range;
  // Strips as wide as those of the narrowest zone.
  const CandidateZone lowest = at(0);
  range.strips = padded(static_cast<int>(std::ceil(range.half_zone / lowest.half_zone * lowest.strips)));
  range.half_zone = lowest.half_zone * range.strips / lowest.strips;
  return range;
}

struct Segment {
  OrbitBranch branch;
  int steps;
};

BranchSettings branch_settings(const SweepParameters& stage_settings, int steps) {
  BranchSettings settings;
  settings.low = stage_settings.frequency_from;
  settings.high = stage_settings.frequency_to;
  settings.scale = 0.5 * (settings.low + settings.high);
  // Speeds at which the number of steps changes.
  const TimeDiscretisation& time = stage_settings.time;
  if (steps > time.steps_per_period)
    settings.high = std::min(settings.high, 2 * time.min_sample_rate / steps);
  if (time.min_sample_rate > 0) settings.low = std::max(settings.low, time.min_sample_rate / steps);
  settings.first_step = 0.02;
  settings.largest_step = 0.1;
  settings.location = 1e-6;
  settings.fold_location = 1e-8;
  settings.grazing_location = 0.05;
  settings.orbit.tolerance = 1e-9;
  return settings;
}

// The branch of one pair, in segments of one number of steps and one candidate contact zone.
class PairBranch {
 public:
  PairBranch(RollingDynamics& dynamics, const SweepParameters& settings,
             std::function<CandidateZone(int level)> zone, double largest_force)
      : dynamics_(dynamics),
        settings_(settings),
        zone_(std::move(zone)),
        largest_force_(largest_force),
        finest_(steps_at(settings.time, settings.frequency_from)) {}

  std::vector<Segment> follow(const std::function<void(long, long, const std::string&)>& report) {
    const double low = settings_.frequency_from, high = settings_.frequency_to;
    int steps = steps_at(settings_.time, high), direction = -1;
    begin(high, steps);
    const long total = std::max(1l, std::lround((high - low) / settings_.frequency_step));
    double lowest = high;
    std::vector<Segment> segments;
    for (;;) {
      segments.push_back({follow_branch(*map_, orbit_, direction, branch_settings(settings_, steps),
                                        [&](const BranchPosition& p) {
                                          map_->take_left_zone();  // beside the orbit
                                          lowest = std::min(lowest, p.parameter);
                                          report(std::lround((high - lowest) / (high - low) * total), total,
                                                 text(p.parameter, " Hz"));
                                        }),
                          steps});
      const OrbitBranch& branch = segments.back().branch;
      const BranchPosition& last = branch.points.back();
      const double at = last.parameter;
      direction = last.turn > 0 ? 1 : -1;
      if (static_cast<int>(segments.size()) == kMostSegments) return segments;
      if (!branch.reached_limit) {
        if (!map_->take_left_zone()) return segments;
        widen();
      } else {
        if (direction > 0 ? at >= high : at <= low) return segments;
        steps = direction > 0 ? steps / 2 : steps * 2;
      }
      resume(last.start, at, steps);
    }
  }
  const std::vector<double>& mismatch() const { return mismatch_; }

 private:
  void widen() {
    if (++level_ > kMostLevel)
      fail_outside_range(Failure::numerical, "contact leaves the flanks: forces above ", largest_force_,
                         " N; lower the torque");
    dynamics_.set_zone(zone_(level_), finest_);
  }
  // The orbit into which the pair settles.
  void begin(double at, int steps) {
    for (level_ = -1; !map_;) {
      widen();
      map_ = std::make_unique<RollingPeriodMap>(dynamics_, steps);
      map_->set_parameter(at);
      RollingDynamics::State state = dynamics_.rest();
      const auto periodic =
          find_periodic_orbit(dynamics_, state, settings_.time.periodicity, SteadyState::extrapolate);
      if (!periodic) {
        map_.reset();
        continue;
      }
      if (periodic->multiple != 1)
        fail(Failure::numerical, "at ", at, " Hz, where the branch begins, the motion ",
             periodic->multiple == 0 ? text("does not repeat within ", periodic->periods, " mesh periods")
                                     : text("repeats after ", periodic->multiple, " mesh periods"),
             "; give mesh_frequency_Hz another upper end");
      if (!found(map_->flat(state), at, steps)) map_.reset();
    }
  }
  // With other steps or another zone: the orbit near that of before.
  void resume(const VectorXd& start, double at, int steps) {
    RollingDynamics::State state = map_->state(start);
    for (;;) {
      map_ = std::make_unique<RollingPeriodMap>(dynamics_, steps);
      map_->set_parameter(at);
      RollingDynamics::State near = state;
      RollingDynamics::Period period;
      // A period puts the contact forces where this zone has its strips.
      if (dynamics_.integrate(near, period) && found(map_->flat(near), at, steps)) break;
      widen();
    }
    if (orbit_.start.size() == start.size())
      mismatch_.push_back((orbit_.start - start).norm() / start.norm());
  }
  bool found(const VectorXd& start, double at, int steps) {
    OrbitSettings settings;
    settings.tolerance = 1e-9;
    const OrbitSearch search = find_orbit(*map_, start, 1, settings);
    if (search.found()) {
      orbit_ = search.orbit;
      return true;
    }
    if (map_->take_left_zone()) return false;
    fail(Failure::numerical, "at ", at, " Hz no orbit of ", steps,
         " steps is found from that at hand: ", search.failure);
  }

  RollingDynamics& dynamics_;
  const SweepParameters& settings_;
  std::function<CandidateZone(int)> zone_;
  double largest_force_;
  int finest_, level_ = 0;
  std::unique_ptr<RollingPeriodMap> map_;
  PeriodicOrbit orbit_;
  std::vector<double> mismatch_;
};

Eigen::VectorXd frequencies(const std::vector<SpecialPoint>& all, Special kind) {
  std::vector<double> found;
  for (const SpecialPoint& p : all)
    if (p.kind == kind) found.push_back(p.parameter);
  return Eigen::Map<const VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): segments of one branch, then its artifact
BranchArtifact pair_branch(const BodyArtifact& driver, const BodyArtifact& driven,
                           const StaticArtifact& statics, double mean_stiffness,
                           const SweepParameters& stage_settings,
                           const std::function<void(long, long, const std::string&)>& report) {
  if (!(stage_settings.frequency_from > 0) || !(stage_settings.frequency_to > stage_settings.frequency_from))
    fail(Failure::input, "a branch needs speeds to go through: mesh_frequency_Hz is from ",
         stage_settings.frequency_from, " to ", stage_settings.frequency_to, " Hz");
  require_inertia(statics.mesh, {driver.inertia, driven.inertia},
                  {stage_settings.driver_inertia, stage_settings.driven_inertia});
  const GearMeshModel model(driver, driven, statics.mesh);
  DynamicParameters parameters;
  parameters.torque = statics.torque;
  parameters.inertia = {stage_settings.driver_inertia, stage_settings.driven_inertia};
  parameters.mean_stiffness = mean_stiffness;
  parameters.damping = stage_settings.damping;
  parameters.fidelity = stage_settings.fidelity;

  RollingDynamics dynamics(model, parameters);
  PairBranch pair(
      dynamics, stage_settings, [&](int level) { return zone(model, statics, level); },
      MotionBounds(model, statics, std::pow(kWidening, kMostLevel)).force);
  const std::vector<Segment> followed = pair.follow(report), *segments = &followed;
  const std::vector<double>& mismatch = pair.mismatch();

  BranchArtifact a;
  set_gears(a, driver, driven);
  a.driver_inertia = stage_settings.driver_inertia;
  a.driven_inertia = stage_settings.driven_inertia;
  a.mesh = statics.mesh;
  a.fidelity = stage_settings.fidelity;
  a.contact = statics.contact;
  a.time = stage_settings.time;
  a.damping = stage_settings.damping;
  a.torque = statics.torque;
  a.end = segments->back().branch.end;
  Eigen::Index points = 0;
  for (const Segment& s : *segments) points += static_cast<Eigen::Index>(s.branch.points.size());
  for (VectorXd* x : {&a.mesh_frequency, &a.dte_rms, &a.dte_mean, &a.residual}) x->resize(points);
  a.stable.resize(points);
  a.steps.resize(points);
  const int harmonic_count = resolved_harmonics(stage_settings.time.steps_per_period, kResponseHarmonics);
  a.dte_harmonic.resize(points, harmonic_count);
  std::vector<SpecialPoint> special;
  std::vector<double> fold_rms;
  Eigen::Index i = 0;
  for (const Segment& s : *segments) {
    const auto& own = s.branch.points;
    const Eigen::Index first = i;
    for (const BranchPosition& p : own) {
      a.mesh_frequency[i] = p.parameter;
      const Harmonics h = harmonics(p.observable, harmonic_count);
      a.dte_rms[i] = h.rms;
      a.dte_mean[i] = h.mean;
      a.dte_harmonic.row(i) = h.amplitude.transpose();
      a.residual[i] = p.residual;
      a.stable[i] = p.stable();
      a.steps[i] = s.steps;
      MatrixRM rows = MatrixRM::Zero(kMultipliers, 2);
      for (Eigen::Index k = 0; k < std::min<Eigen::Index>(kMultipliers, p.multipliers.size()); ++k)
        rows.row(k) << p.multipliers[k].real(), p.multipliers[k].imag();
      a.floquet_multiplier.push_back(rows);
      ++i;
    }
    for (const SpecialPoint& p : s.branch.special) {
      special.push_back(p);
      if (p.kind != Special::fold) continue;
      // Between two points the RMS goes with the arc.
      const BranchPosition& before = own[p.after_point];
      const Eigen::Index row = first + static_cast<Eigen::Index>(p.after_point);
      double share = 0;
      if (p.after_point + 1 < own.size() && own[p.after_point + 1].arc > before.arc)
        share = (p.arc - before.arc) / (own[p.after_point + 1].arc - before.arc);
      const Eigen::Index next = std::min(row + 1, points - 1);
      fold_rms.push_back((1 - share) * a.dte_rms[row] + share * a.dte_rms[next]);
    }
  }
  a.segment_mismatch =
      Eigen::Map<const VectorXd>(mismatch.data(), static_cast<Eigen::Index>(mismatch.size()));
  a.fold_frequency = frequencies(special, Special::fold);
  a.fold_rms = Eigen::Map<const VectorXd>(fold_rms.data(), static_cast<Eigen::Index>(fold_rms.size()));
  a.flip_frequency = frequencies(special, Special::flip);
  a.torus_frequency = frequencies(special, Special::torus);
  a.grazing_frequency = frequencies(special, Special::grazing);
  a.fold_smooth.resize(a.fold_frequency.size());
  a.fold_multiplier.resize(a.fold_frequency.size(), 2);
  a.grazing_phase.resize(a.grazing_frequency.size());
  a.grazing_pair.resize(a.grazing_frequency.size());
  a.grazing_closes.resize(a.grazing_frequency.size());
  Eigen::Index fold = 0, grazing = 0;
  for (const SpecialPoint& p : special)
    if (p.kind == Special::fold) {
      a.fold_smooth[fold] = p.smooth;
      a.fold_multiplier.row(fold++) << p.before.real(), p.after.real();
    } else if (p.kind == Special::grazing) {
      a.grazing_phase[grazing] = p.event.phase;
      a.grazing_pair[grazing] = p.event.contact;
      a.grazing_closes[grazing++] = p.event.closes;
    }
  return a;
}

}  // namespace whine
