#include "studies/sustained_peaks.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "signal/branches.h"

namespace whine {

using Eigen::VectorXd;

namespace {

int samples_of(int steps) {
  constexpr int kMost = 128;
  while (steps > kMost && steps % 2 == 0) steps /= 2;
  return steps;
}

std::vector<double> phases_of(int samples) {
  std::vector<double> phases(static_cast<size_t>(samples));
  for (int n = 0; n < samples; ++n) phases[static_cast<size_t>(n)] = static_cast<double>(n) / samples;
  return phases;
}

}  // namespace

SustainedPeaks::SustainedPeaks(const GearMeshModel& model, int steps)
    : roots_(std::in_place, model, phases_of(samples_of(steps))), samples_(samples_of(steps)) {}

SustainedPeaks::SustainedPeaks(int steps) : samples_(samples_of(steps)) {}

VectorXd SustainedPeaks::of(const Eigen::Ref<const Eigen::MatrixXd>& tooth_pair_load, int number,
                            int periods) {
  const Eigen::Index pairs = tooth_pair_load.rows(), stride = tooth_pair_load.cols() / samples_;
  const int reach = static_cast<int>(pairs) / 2;
  pair_ = Eigen::VectorXi::LinSpaced(pairs, -reach, reach);
  load_.resize(samples_, pairs);
  along_.resize(samples_, root_stress() ? kRows - 1 : 1);
  for (Eigen::Index n = 0; n < samples_; ++n) {
    load_.row(n) = tooth_pair_load.col(n * stride).transpose();
    along_(n, 0) = load_.row(n).sum();
    for (int g = 0; root_stress() && g < kSides; ++g) {
      const RootStress at = roots_->largest(g, static_cast<size_t>(n), pair_, load_.row(n).transpose());
      along_(n, 1 + g) = at.stress;
      along_(n, 1 + kSides + g) = at.angle;
      along_(n, 1 + 2 * kSides + g) = static_cast<double>(n) / samples_ + at.pair;
    }
  }
  const Eigen::Index seam = sustained_samples(samples_) - 1;
  if (number == 0) first_ = along_.topRows(seam);
  const Eigen::Index before = number > 0 ? seam : 0, after = number + 1 == periods ? seam : 0;
  joined_.resize(before + samples_ + after, along_.cols());
  if (before > 0) joined_.topRows(before) = last_;
  joined_.middleRows(before, samples_) = along_;
  if (after > 0) joined_.bottomRows(after) = first_;
  last_ = along_.bottomRows(seam);
  VectorXd out(along_.cols() + 1);
  out[0] = sustained_load(joined_.col(0), samples_);
  out[1] = sustained_load(load_, samples_);
  for (int g = 0; root_stress() && g < kSides; ++g) {
    const VectorXd stress = joined_.col(1 + g);
    const Eigen::Index at = sustained_row(stress, samples_);
    out[2 + g] = sustained_load(stress, samples_);
    out[2 + kSides + g] = joined_(at, 1 + kSides + g);
    out[2 + 2 * kSides + g] = joined_(at, 1 + 2 * kSides + g);
  }
  return out;
}

VectorXd SustainedPeaks::so_far(const Eigen::Ref<const Eigen::MatrixXd>& tooth_pair_load, int number,
                                int periods) {
  const VectorXd own = of(tooth_pair_load, number, periods);
  if (number == 0) return so_far_ = own;
  for (Eigen::Index k = 0; k < 2; ++k) so_far_[k] = std::max(so_far_[k], own[k]);
  for (Eigen::Index k = 2; k < own.size() && k < 2 + kSides; ++k)
    if (own[k] > so_far_[k])  // and its place
      for (Eigen::Index of_gear = k; of_gear < kRows; of_gear += kSides) so_far_[of_gear] = own[of_gear];
  return so_far_;
}

}  // namespace whine
