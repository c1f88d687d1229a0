#include "studies/system_branch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/dynamics.h"
#include "dynamics/system_period_map.h"
#include "orbits/branch.h"
#include "orbits/periodic_motion.h"
#include "studies/branch_follower.h"
#include "studies/sweep.h"
#include "studies/train_in_motion.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

struct Segment {
  OrbitBranch branch;
  int steps = 0;  // per period
};

// Steps as along the branch of a pair, but no grazing orbits.
BranchSettings segment_settings(const SystemSweepParameters& p, int steps, double tolerance) {
  BranchSettings settings = segment_speeds(p.time, p.frequency_from, p.frequency_to, steps);
  settings.first_step = 0.02;
  settings.largest_step = 0.06;
  settings.straight = 0.99;
  settings.location = 1e-6;
  settings.fold_location = 1e-8;
  settings.grazing_location = 1;
  settings.orbit.tolerance = tolerance;
  return settings;
}

// Of a period, for each mesh and then each body: the columns of the artifact, one after the other.
VectorXd measured(const SystemDynamics::Period& period) {
  const Index meshes = period.mesh_force.rows();
  const std::vector<Eigen::Matrix2Xd>& forces = period.bearing_force;
  VectorXd out(5 * meshes + static_cast<Index>(forces.size()));
  for (Index m = 0; m < meshes; ++m) {
    const VectorXd error = period.transmission_error.row(m);
    const double mean = error.mean();
    out[m] = std::sqrt((error.array() - mean).square().mean());
    out[meshes + m] = mean;
    out[2 * meshes + m] = period.mesh_force.row(m).maxCoeff();
    out[3 * meshes + m] = period.largest_tooth_force.row(m).maxCoeff();
    out[4 * meshes + m] = 1 - static_cast<double>((period.largest_tooth_force.row(m).array() > 0).count()) /
                                  static_cast<double>(error.size());
  }
  for (size_t b = 0; b < forces.size(); ++b) {
    const Eigen::Matrix2Xd swing = forces[b].colwise() - forces[b].rowwise().mean();
    out[5 * meshes + static_cast<Index>(b)] = std::sqrt(swing.colwise().squaredNorm().mean());
  }
  return out;
}

class Follower {
 public:
  Follower(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies, double tolerance)
      : settings_(settings),
        rig_(settings, bodies, steps_at(settings.time, settings.frequency_from)),
        tolerance_(tolerance) {}

  const TrainInMotion& rig() const { return rig_; }
  const std::vector<double>& mismatch() const { return mismatch_; }

  // From the orbit at the highest speed, from segment to segment.
  std::vector<Segment> follow(const std::function<void(long, long, const std::string&)>& report) {
    const double low = settings_.frequency_from, high = settings_.frequency_to;
    const long total = std::max(1L, std::lround((high - low) / settings_.frequency_step));
    int steps = steps_at(settings_.time, high), direction = -1;
    begin(high, steps);
    std::vector<Segment> out;
    double lowest = high;
    for (;;) {
      const BranchSettings own = segment_settings(settings_, steps, tolerance_);
      out.push_back(
          {follow_branch(*map_, orbit_, direction, own,
                         [&](const BranchPosition& p) {
                           map_->take_left_zone();  // beside the orbit
                           lowest = std::min(lowest, p.parameter);
                           report(std::lround((high - lowest) / (high - low) * static_cast<double>(total)),
                                  total, text(p.parameter, " Hz"));
                         }),
           steps});
      const OrbitBranch& branch = out.back().branch;
      const BranchPosition& last = branch.points.back();
      const double at = last.parameter;
      direction = branch.reached_limit != 0 ? branch.reached_limit : last.turn > 0 ? 1 : -1;
      if (static_cast<int>(out.size()) == kMostSegments) {
        note_most_segments(out.back().branch);
        return out;
      }
      SystemDynamics::State state = map_->state(last.start);
      const bool wider = branch.reached_limit == 0;
      if (wider) {
        if (!map_->take_left_zone()) return out;
        state = rig_.widen(state);
      } else {
        const auto beyond = steps_beyond(settings_.time, low, high, steps, branch);
        if (!beyond) return out;
        steps = *beyond;
      }
      const VectorXd before = last.start;
      try {
        resume(state, at, steps);
      } catch (const Error& error) {
        if (error.kind() != Failure::numerical || wider) throw;
        note_steps_change(out.back().branch, error.what());
        return out;
      }
      // In other positions a state has other slots.
      if (!wider && before.size() == orbit_.start.size())
        mismatch_.push_back((orbit_.start - before).norm() / before.norm());
    }
  }

 private:
  void new_map(double at, int steps) {
    map_ = std::make_unique<SystemPeriodMap>(rig_.dynamics(), steps);
    map_->measure(measured);
    map_->set_parameter(at);
  }

  // The orbit into which the system settles.
  void begin(double at, int steps) {
    SystemDynamics::State state = rig_.dynamics().rest();
    for (;;) {
      new_map(at, steps);
      PeriodicMotion motion;
      try {
        motion = iterate_to_orbit(*map_, map_->flat(state),
                                  {settings_.time.periodicity, kMostSystemPeriods, true});
      } catch (const ModelRangeError&) {
        if (!map_->left_last()) throw;
        state = rig_.widen(state);
        continue;
      }
      if (motion.multiple != 1)
        fail(Failure::numerical, "at ", at, " Hz, where the branch begins, the motion ",
             motion.multiple == 0 ? text("does not repeat within ", motion.turns, " mesh periods")
                                  : text("repeats after ", motion.multiple, " mesh periods"),
             "; give mesh_frequency_Hz another upper end");
      return resume(map_->state(motion.state), at, steps);
    }
  }

  // Newton's method from a state nearby.
  void resume(SystemDynamics::State state, double at, int steps) {
    for (;;) {
      new_map(at, steps);
      OrbitSettings settings;
      settings.tolerance = tolerance_;
      const OrbitSearch search = newton_orbit(*map_, map_->flat(state), 1, settings);
      if (search.found()) {
        map_->take_left_zone();
        orbit_ = search.orbit;
        return;
      }
      if (!map_->take_left_zone())
        fail(Failure::numerical, "at ", at, " Hz no orbit of ", steps,
             " steps is found from that at hand: ", search.failure);
      state = rig_.widen(state);
    }
  }

  const SystemSweepParameters& settings_;
  TrainInMotion rig_;
  double tolerance_;
  std::unique_ptr<SystemPeriodMap> map_;
  PeriodicOrbit orbit_;
  std::vector<double> mismatch_;
};

void store_point(const BranchPosition& p, int steps, Index i, SystemBranchResult& a) {
  const Index meshes = a.dte_rms.cols();
  a.mesh_frequency[i] = p.parameter;
  Index at = 0;
  for (MatrixRM* x :
       {&a.dte_rms, &a.dte_mean, &a.mesh_force_max, &a.tooth_force_max, &a.separation_fraction}) {
    x->row(i) = p.peaks.segment(at, meshes).transpose();
    at += meshes;
  }
  a.bearing_force_rms.row(i) = p.peaks.tail(p.peaks.size() - at).transpose();
  MatrixRM rows = MatrixRM::Zero(kKeptMultipliers, 2);
  for (Index k = 0; k < std::min<Index>(kKeptMultipliers, p.multipliers.size()); ++k)
    rows.row(k) << p.multipliers[k].real(), p.multipliers[k].imag();
  a.floquet_multiplier[static_cast<size_t>(i)] = rows;
  a.stable[i] = p.stable() ? 1 : 0;
  a.steps[i] = steps;
  a.residual[i] = p.residual;
}

void store_special(const std::vector<SpecialPoint>& special, SystemBranchResult& a) {
  a.fold_frequency = parameters_of(special, Special::fold);
  a.fold_width = widths_of(special, Special::fold, kStepError);
  a.flip_frequency = parameters_of(special, Special::flip);
  a.flip_width = widths_of(special, Special::flip, kStepError);
  a.torus_frequency = parameters_of(special, Special::torus);
  a.torus_width = widths_of(special, Special::torus, kStepError);
  a.fold_smooth.resize(a.fold_frequency.size());
  a.fold_multiplier.resize(a.fold_frequency.size(), 2);
  Index fold = 0;
  for (const SpecialPoint& p : special) {
    if (p.kind != Special::fold) continue;
    a.fold_smooth[fold] = p.smooth ? 1 : 0;
    a.fold_multiplier.row(fold++) << p.before.real(), p.after.real();
  }
}

}  // namespace

SystemBranchResult system_branch(const SystemSweepParameters& settings,
                                 const std::vector<ReducedBody>& bodies,
                                 const std::function<void(long, long, const std::string&)>& report,
                                 const SystemBranchPlan& plan) {
  if (!(plan.tolerance >= 1e-12 && plan.tolerance <= 1e-3))
    fail(Failure::input, "an orbit's tolerance of ", plan.tolerance, "; give 1e-12 to 1e-3");
  if (!(settings.frequency_from > 0) || !(settings.frequency_to > settings.frequency_from))
    fail(Failure::input, "a branch needs speeds to go through: mesh_frequency_Hz is from ",
         settings.frequency_from, " to ", settings.frequency_to, " Hz");
  require_like_teeth(settings, "a branch of a system");
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  Follower follower(settings, bodies, plan.tolerance);
  const std::vector<Segment> segments = follower.follow(report);
  const auto meshes = static_cast<Index>(settings.layout.meshes.size()),
             all = static_cast<Index>(settings.layout.bodies.size());
  SystemBranchResult a;
  a.settings = follower.rig().used();
  a.torque.setZero(all);
  for (int b = 0; b < all; ++b) a.torque[b] = settings.layout.torque(b);
  a.axis_frequency = follower.rig().motion().axis_frequency / (2 * std::numbers::pi);
  Index points = 0;
  for (const Segment& s : segments) points += static_cast<Index>(s.branch.points.size());
  for (MatrixRM* x : {&a.dte_rms, &a.dte_mean, &a.mesh_force_max, &a.tooth_force_max, &a.separation_fraction})
    x->resize(points, meshes);
  a.bearing_force_rms.resize(points, all);
  for (VectorXd* x : {&a.mesh_frequency, &a.residual}) x->resize(points);
  for (Eigen::VectorXi* x : {&a.stable, &a.steps}) x->resize(points);
  a.floquet_multiplier.resize(static_cast<size_t>(points));
  a.end = segments.back().branch.end;
  Index i = 0;
  std::vector<SpecialPoint> special;
  for (const Segment& s : segments) {
    for (const BranchPosition& p : s.branch.points) store_point(p, s.steps, i++, a);
    special.insert(special.end(), s.branch.special.begin(), s.branch.special.end());
  }
  store_special(special, a);
  a.segment_mismatch =
      Eigen::Map<const VectorXd>(follower.mismatch().data(), static_cast<Index>(follower.mismatch().size()));
  return a;
}

}  // namespace whine
