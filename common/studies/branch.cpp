#include "studies/branch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "dynamics/lines_motion.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/motion_statistics.h"
#include "studies/pair_in_motion.h"
#include "studies/sustained_peaks.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// What a branch says of an orbit, a row of each; and its harmonics.
std::array<MatrixRM*, 11> columns_of(BranchResult& a) {
  return {&a.dte_rms,
          &a.dte_mean,
          &a.mesh_force_max,
          &a.tooth_load_max,
          &a.separation_fraction,
          &a.mesh_force_sustained,
          &a.tooth_load_sustained,
          &a.bearing_force_rms,
          &a.root_stress_sustained,
          &a.root_stress_angle,
          &a.root_stress_phase};
}

// An orbit as it is measured, period by period: a branch of one point.
class MeasuredOrbit {
 public:
  // peaks: [mesh]; bodies: whose bearings count, 0 for none; steps: stored in a mesh period.
  MeasuredOrbit(std::vector<SustainedPeaks> peaks, Index bodies, int steps)
      : peaks_(std::move(peaks)), harmonics_(resolved_harmonics(steps, kResponseHarmonics)) {
    const auto meshes = static_cast<Index>(peaks_.size());
    for (MatrixRM* x : columns_of(row_)) x->setZero(1, meshes);
    row_.bearing_force_rms.setZero(1, bodies);
    const bool roots = std::any_of(peaks_.begin(), peaks_.end(),
                                   [](const SustainedPeaks& mesh) { return mesh.root_stress(); });
    for (MatrixRM* x : {&row_.root_stress_sustained, &row_.root_stress_angle, &row_.root_stress_phase})
      x->setZero(1, roots ? kSides * meshes : 0);
    row_.dte_harmonic = {MatrixRM::Zero(harmonics_, meshes)};
  }

  // Values of the orbit, columns_of() one after the other and the harmonics, when its last period has come.
  VectorXd take(const MotionPeriod& period, int number, int periods) {
    if (number == 0) statistics_.clear();
    statistics_.take(period);
    const auto meshes = static_cast<Index>(peaks_.size());
    for (Index m = 0; m < meshes; ++m)
      take_peaks(peaks_[static_cast<size_t>(m)].so_far(period, number, periods), m);
    if (number + 1 < periods) return {};
    for (Index m = 0; m < meshes; ++m) {
      const Harmonics dte = statistics_.dte(m, harmonics_, periods);
      row_.dte_rms(0, m) = dte.rms;
      row_.dte_mean(0, m) = dte.mean;
      row_.dte_harmonic[0].col(m) = dte.amplitude;
    }
    row_.mesh_force_max = statistics_.mesh_force_max().transpose();
    row_.tooth_load_max = statistics_.tooth_load_max().transpose();
    row_.separation_fraction = statistics_.separation_fraction().transpose();
    if (row_.bearing_force_rms.size() > 0)
      row_.bearing_force_rms = statistics_.bearing_force_rms().transpose();
    return packed();
  }

  void size(Index points, BranchResult& a) {
    const auto own = columns_of(row_), all = columns_of(a);
    for (size_t k = 0; k < own.size(); ++k) all[k]->resize(points, own[k]->cols());
    a.dte_harmonic.assign(static_cast<size_t>(points), row_.dte_harmonic[0]);
  }

  // Such values into point i.
  static void store(const VectorXd& values, Index i, BranchResult& a) {
    Index at = 0;
    for (MatrixRM* x : columns_of(a)) {
      x->row(i) = values.segment(at, x->cols()).transpose();
      at += x->cols();
    }
    a.dte_harmonic[static_cast<size_t>(i)].reshaped<Eigen::RowMajor>() = values.tail(values.size() - at);
  }

 private:
  void take_peaks(const VectorXd& peaks, Index mesh) {
    row_.mesh_force_sustained(0, mesh) = peaks[0];
    row_.tooth_load_sustained(0, mesh) = peaks[1];
    if (peaks.size() < SustainedPeaks::kRows) return;
    Index at = 2;
    for (MatrixRM* x : {&row_.root_stress_sustained, &row_.root_stress_angle, &row_.root_stress_phase}) {
      x->middleCols<kSides>(kSides * mesh) = peaks.segment<kSides>(at).transpose();
      at += kSides;
    }
  }

  VectorXd packed() {
    Index at = row_.dte_harmonic[0].size();
    for (const MatrixRM* x : columns_of(row_)) at += x->size();
    VectorXd out(at);
    at = 0;
    for (const MatrixRM* x : columns_of(row_)) {
      out.segment(at, x->size()) = x->transpose();
      at += x->size();
    }
    out.tail(out.size() - at) = row_.dte_harmonic[0].reshaped<Eigen::RowMajor>();
    return out;
  }

  std::vector<SustainedPeaks> peaks_;
  int harmonics_;
  MotionStatistics statistics_;
  BranchResult row_;
};

void store_points(const std::vector<BranchSegment>& segments, MeasuredOrbit& orbit, BranchResult& a) {
  Index points = 0;
  for (const auto& s : segments) points += static_cast<Index>(s.branch.points.size());
  orbit.size(points, a);
  for (VectorXd* x : {&a.mesh_frequency, &a.residual}) x->resize(points);
  for (Eigen::VectorXi* x : {&a.stable, &a.steps, &a.period_multiple, &a.part}) x->resize(points);
  a.floquet_multiplier.reserve(static_cast<size_t>(points));
  Index i = 0;
  for (const auto& s : segments)
    for (const BranchPosition& p : s.branch.points) {
      MeasuredOrbit::store(p.peaks, i, a);
      a.mesh_frequency[i] = p.parameter;
      a.residual[i] = p.residual;
      a.stable[i] = p.stable();
      a.steps[i] = s.steps;
      a.period_multiple[i] = s.multiple;
      a.part[i] = s.part;
      MatrixRM rows = MatrixRM::Zero(kKeptMultipliers, 2);
      for (Index k = 0; k < std::min<Index>(kKeptMultipliers, p.multipliers.size()); ++k)
        rows.row(k) << p.multipliers[k].real(), p.multipliers[k].imag();
      a.floquet_multiplier.push_back(rows);
      ++i;
    }
}

// The RMS at a fold, which goes with the arc between two points; `first`: row of the first of its segment.
Eigen::RowVectorXd rms_at(const OrbitBranch& branch, const SpecialPoint& fold, Index first,
                          const BranchResult& a) {
  const auto& own = branch.points;
  const BranchPosition& before = own[fold.after_point];
  const Index row = first + static_cast<Index>(fold.after_point),
              next = std::min(row + 1, a.dte_rms.rows() - 1);
  double share = 0;
  if (fold.after_point + 1 < own.size() && own[fold.after_point + 1].arc > before.arc)
    share = (fold.arc - before.arc) / (own[fold.after_point + 1].arc - before.arc);
  return (1 - share) * a.dte_rms.row(row) + share * a.dte_rms.row(next);
}

// All points being stored.
void store_special(const std::vector<BranchSegment>& segments, BranchResult& a) {
  std::vector<SpecialPoint> special;
  for (const auto& s : segments)
    special.insert(special.end(), s.branch.special.begin(), s.branch.special.end());
  a.fold_frequency = parameters_of(special, Special::fold);
  a.fold_width = widths_of(special, Special::fold, kStepError);
  a.flip_frequency = parameters_of(special, Special::flip);
  a.flip_width = widths_of(special, Special::flip, kStepError);
  a.torus_frequency = parameters_of(special, Special::torus);
  a.torus_width = widths_of(special, Special::torus, kStepError);
  a.grazing_frequency = parameters_of(special, Special::grazing);
  const Index folds = a.fold_frequency.size(), grazings = a.grazing_frequency.size();
  a.fold_smooth.resize(folds);
  a.fold_multiplier.resize(folds, 2);
  a.fold_rms.resize(folds, a.dte_rms.cols());
  a.grazing_phase.resize(grazings);
  for (Eigen::VectorXi* x : {&a.grazing_closes, &a.grazing_mesh, &a.grazing_pair}) x->resize(grazings);
  Index first = 0, turn = 0, graze = 0;
  for (const auto& s : segments) {
    for (size_t k = 0; k < s.branch.special.size(); ++k)
      if (const SpecialPoint& p = s.branch.special[k]; p.kind == Special::fold) {
        a.fold_rms.row(turn) = rms_at(s.branch, p, first, a);
        a.fold_smooth[turn] = p.smooth;
        a.fold_multiplier.row(turn++) << p.before.real(), p.after.real();
      } else if (p.kind == Special::grazing) {
        a.grazing_phase[graze] = p.event.phase - std::floor(p.event.phase);  // of the mesh period
        a.grazing_mesh[graze] = s.special_place[k].first;
        a.grazing_pair[graze] = s.special_place[k].second;
        a.grazing_closes[graze++] = p.event.closes;
      }
    first += static_cast<Index>(s.branch.points.size());
  }
}

// source: of what moves.
BranchResult followed(Motion& motion, MotionSource source, const MotionSettings& speeds,
                      const BranchPlan& plan, const BranchReport& report) {
  BranchFollower follower(motion, speeds);
  const int steps = speeds.time.steps_per_period;
  MeasuredOrbit orbit(sustained_peaks(motion.system(), steps),
                      source.of_train() || source.mesh.on_bearings() ? source.bodies() : 0, steps);
  follower.measure([&orbit](const MotionPeriod& period, int number, int periods) {
    return orbit.take(period, number, periods);
  });
  const auto& segments = follower.follow(plan, report);
  BranchResult a;
  static_cast<MotionSource&>(a) = std::move(source);
  store_points(segments, orbit, a);
  store_special(segments, a);
  a.end = ends_of(segments);
  a.segment_mismatch =
      Eigen::Map<const VectorXd>(follower.mismatch().data(), static_cast<Index>(follower.mismatch().size()));
  return a;
}

}  // namespace

BranchResult pair_branch(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double mean_stiffness, const SweepParameters& settings, const BranchReport& report,
                         const BranchPlan& plan) {
  const PairInMotion pair(driver, driven, statics, mean_stiffness, settings);
  return followed(*pair.motion, pair.source, settings, plan, report);
}

BranchResult system_branch(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                           const BranchReport& report, const BranchPlan& plan) {
  require_able("branches", traits(settings, bodies));
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  LinesMotion motion(settings, bodies, steps_at(settings.time, settings.frequency_from));
  return followed(motion, motion.source(), settings, plan, report);
}

}  // namespace whine
