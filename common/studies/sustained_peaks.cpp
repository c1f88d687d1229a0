#include "studies/sustained_peaks.h"

#include <algorithm>

#include "signal/branches.h"

namespace whine {

using Eigen::VectorXd;

namespace {

int samples_of(int steps) {
  constexpr int kMost = 128;
  while (steps > kMost && steps % 2 == 0) steps /= 2;
  return steps;
}

}  // namespace

SustainedPeaks::SustainedPeaks(const SystemModel& system, Eigen::Index mesh, int steps)
    : mesh_(mesh), samples_(samples_of(steps)), roots_(system, mesh, samples_) {}

std::vector<SustainedPeaks> sustained_peaks(const SystemModel& system, int steps) {
  std::vector<SustainedPeaks> out;
  out.reserve(system.mesh.size());
  for (size_t m = 0; m < system.mesh.size(); ++m)
    out.emplace_back(system, static_cast<Eigen::Index>(m), steps);
  return out;
}

VectorXd SustainedPeaks::of(const MotionPeriod& period, int number, int periods) {
  const auto tooth_pair_load = period.loads_of(mesh_);
  const Eigen::Index pairs = tooth_pair_load.rows(), stride = tooth_pair_load.cols() / samples_;
  load_.resize(samples_, pairs);
  along_.resize(samples_, root_stress() ? kRows - 1 : 1);
  for (Eigen::Index n = 0; n < samples_; ++n) {
    load_.row(n) = tooth_pair_load.col(n * stride).transpose();
    along_(n, 0) = load_.row(n).sum();
    if (!root_stress()) continue;
    const int first = period.first_pair + roots_.ahead(n), last = first + static_cast<int>(pairs) - 1;
    const Eigen::VectorXi numbers = Eigen::VectorXi::LinSpaced(pairs, first, last);
    // Sample 0 is that of the end.
    const Eigen::Index sample = n + static_cast<Eigen::Index>(n == 0 ? number + 1 : number) * samples_;
    for (int g = 0; g < kSides; ++g) {
      const RootStress at = roots_.largest(g, sample, numbers, load_.row(n).transpose());
      along_(n, 1 + g) = at.stress;
      along_(n, 1 + kSides + g) = at.angle;
      along_(n, 1 + 2 * kSides + g) = roots_.phase(n, at);
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

VectorXd SustainedPeaks::so_far(const MotionPeriod& period, int number, int periods) {
  const VectorXd own = of(period, number, periods);
  if (number == 0) return so_far_ = own;
  for (Eigen::Index k = 0; k < 2; ++k) so_far_[k] = std::max(so_far_[k], own[k]);
  for (Eigen::Index k = 2; k < own.size() && k < 2 + kSides; ++k)
    if (own[k] > so_far_[k])  // and its place
      for (Eigen::Index of_gear = k; of_gear < kRows; of_gear += kSides) so_far_[of_gear] = own[of_gear];
  return so_far_;
}

}  // namespace whine
