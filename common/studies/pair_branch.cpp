#include "studies/pair_branch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/branch_follower.h"
#include "studies/sustained_peaks.h"

namespace whine {

using Eigen::VectorXd;

// NOLINTNEXTLINE(readability-function-size): segments of one branch, then its artifact
BranchResult pair_branch(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double mean_stiffness, const SweepParameters& stage_settings,
                         const std::function<void(long, long, const std::string&)>& report,
                         const BranchPlan& plan) {
  if (plan.most_periods != 1 && plan.most_periods != 2 && plan.most_periods != 4)
    fail(Failure::input, "orbits of ", plan.most_periods, " mesh periods are not followed; give 1, 2 or 4");
  if (!(plan.tolerance >= 1e-12 && plan.tolerance <= 1e-3))
    fail(Failure::input, "an orbit's tolerance of ", plan.tolerance, "; give 1e-12 to 1e-3");
  if (!(stage_settings.frequency_from > 0) || !(stage_settings.frequency_to > stage_settings.frequency_from))
    fail(Failure::input, "a branch needs speeds to go through: mesh_frequency_Hz is from ",
         stage_settings.frequency_from, " to ", stage_settings.frequency_to, " Hz");
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, stage_settings.inertia);
  const GearMeshModel model(driver, driven, statics.mesh);
  RollingDynamics dynamics(
      model, dynamic_parameters(statics, mean_stiffness, stage_settings, stage_settings.frequency_to));
  BranchFollower follower(dynamics, model, statics, stage_settings, BranchFollower::Look::close,
                          plan.tolerance);
  SustainedPeaks peaks(model, stage_settings.time.steps_per_period);
  follower.measure([&peaks](const RollingDynamics::Period& period, int number, int periods) {
    return peaks.so_far(period, number, periods);
  });
  std::vector<BranchSegment> segments =
      plan.sweep ? follower.follow_from_sweep(*plan.sweep, plan.at, report) : follower.follow(report);
  follower.follow_flips(segments, plan.most_periods, report);
  const std::vector<double>& mismatch = follower.mismatch();

  BranchResult a;
  set_motion(a, {driver, driven}, statics, stage_settings);
  a.time = stage_settings.time;
  a.torque = statics.torque;
  // Why each part ends.
  for (size_t k = 0; k < segments.size(); ++k)
    if (k + 1 == segments.size() || segments[k + 1].part != segments[k].part)
      a.end += (a.end.empty() ? "" : "; ") + segments[k].branch.end;
  Eigen::Index points = 0;
  for (const BranchSegment& s : segments) points += static_cast<Eigen::Index>(s.branch.points.size());
  for (VectorXd* x : {&a.mesh_frequency, &a.dte_rms, &a.dte_mean, &a.residual}) x->resize(points);
  for (Eigen::VectorXi* x : {&a.stable, &a.steps, &a.period_multiple, &a.part}) x->resize(points);
  for (VectorXd* x : {&a.mesh_force_sustained, &a.tooth_load_sustained}) x->resize(points);
  for (auto* x : {&a.root_stress_sustained, &a.root_stress_angle, &a.root_stress_phase})
    for (VectorXd& of_gear : *x) of_gear.resize(peaks.root_stress() ? points : 0);
  const int harmonic_count = resolved_harmonics(stage_settings.time.steps_per_period, kResponseHarmonics);
  a.dte_harmonic.resize(points, harmonic_count);
  std::vector<SpecialPoint> special;
  std::vector<double> fold_rms;
  Eigen::Index i = 0;
  for (const BranchSegment& s : segments) {
    const auto& own = s.branch.points;
    const Eigen::Index first = i;
    for (const BranchPosition& p : own) {
      a.mesh_frequency[i] = p.parameter;
      const Harmonics h = harmonics(p.observable, harmonic_count, s.multiple);
      a.dte_rms[i] = h.rms;
      a.dte_mean[i] = h.mean;
      a.dte_harmonic.row(i) = h.amplitude.transpose();
      a.mesh_force_sustained[i] = p.peaks[0];
      a.tooth_load_sustained[i] = p.peaks[1];
      for (int g = 0; peaks.root_stress() && g < kSides; ++g) {
        a.root_stress_sustained[static_cast<size_t>(g)][i] = p.peaks[2 + g];
        a.root_stress_angle[static_cast<size_t>(g)][i] = p.peaks[2 + kSides + g];
        a.root_stress_phase[static_cast<size_t>(g)][i] = p.peaks[2 + 2 * kSides + g];
      }
      a.residual[i] = p.residual;
      a.stable[i] = p.stable();
      a.steps[i] = s.steps;
      a.period_multiple[i] = s.multiple;
      a.part[i] = s.part;
      MatrixRM rows = MatrixRM::Zero(kKeptMultipliers, 2);
      for (Eigen::Index k = 0; k < std::min<Eigen::Index>(kKeptMultipliers, p.multipliers.size()); ++k)
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
  a.fold_frequency = parameters_of(special, Special::fold);
  a.fold_width = widths_of(special, Special::fold, kStepError);
  a.fold_rms = Eigen::Map<const VectorXd>(fold_rms.data(), static_cast<Eigen::Index>(fold_rms.size()));
  a.flip_frequency = parameters_of(special, Special::flip);
  a.flip_width = widths_of(special, Special::flip, kStepError);
  a.torus_frequency = parameters_of(special, Special::torus);
  a.torus_width = widths_of(special, Special::torus, kStepError);
  a.grazing_frequency = parameters_of(special, Special::grazing);
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
      a.grazing_phase[grazing] = p.event.phase - std::floor(p.event.phase);  // of the mesh period
      a.grazing_pair[grazing] = p.event.contact;
      a.grazing_closes[grazing++] = p.event.closes;
    }
  return a;
}

}  // namespace whine
