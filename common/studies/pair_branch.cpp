#include "studies/pair_branch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/branch_follower.h"
#include "studies/branch_rows.h"
#include "studies/sustained_peaks.h"

namespace whine {

using Eigen::VectorXd;

BranchResult pair_branch(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double mean_stiffness, const SweepParameters& stage_settings,
                         const std::function<void(long, long, const std::string&)>& report,
                         const BranchPlan& plan) {
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, stage_settings.inertia);
  const GearMeshModel model(driver, driven, statics.mesh);
  RollingDynamics dynamics(
      model, dynamic_parameters(statics, mean_stiffness, stage_settings, stage_settings.frequency_to));
  PairRig rig(dynamics, model, statics, stage_settings);
  BranchFollower<PairRig> follower(rig, speeds_of(stage_settings));
  SustainedPeaks peaks(model, stage_settings.time.steps_per_period);
  follower.measure([&peaks](const RollingDynamics::Period& period, int number, int periods) {
    return peaks.so_far(period, number, periods);
  });
  const auto& segments = follower.follow(plan, report);

  BranchResult a;
  set_motion(a, {driver, driven}, statics, stage_settings);
  a.time = stage_settings.time;
  a.torque = statics.torque;
  const Eigen::Index points = points_of(segments);
  for (VectorXd* x : {&a.dte_rms, &a.dte_mean, &a.mesh_force_sustained, &a.tooth_load_sustained})
    x->resize(points);
  for (auto* x : {&a.root_stress_sustained, &a.root_stress_angle, &a.root_stress_phase})
    for (VectorXd& of_gear : *x) of_gear.resize(peaks.root_stress() ? points : 0);
  const int harmonic_count = resolved_harmonics(stage_settings.time.steps_per_period, kResponseHarmonics);
  a.dte_harmonic.resize(points, harmonic_count);
  const auto point = [&](Eigen::Index i, const BranchPosition& p, int multiple) {
    const Harmonics h = harmonics(p.observable, harmonic_count, multiple);
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
  };
  std::vector<double> fold_rms;
  std::vector<int> grazing_pair;
  fill_branch(
      segments, follower.mismatch(), point,
      [&](Eigen::Index, const BranchPlace& place) { fold_rms.push_back(place.of(a.dte_rms)[0]); },
      [&](int, int pair) { grazing_pair.push_back(pair); }, a);
  a.fold_rms = Eigen::Map<const VectorXd>(fold_rms.data(), static_cast<Eigen::Index>(fold_rms.size()));
  a.grazing_pair =
      Eigen::Map<const Eigen::VectorXi>(grazing_pair.data(), static_cast<Eigen::Index>(grazing_pair.size()));
  return a;
}

}  // namespace whine
