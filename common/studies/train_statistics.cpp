#include "studies/train_statistics.h"

#include <algorithm>
#include <vector>

#include "signal/response.h"
#include "signal/rms.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

TrainStatistics::TrainStatistics(const SystemStaticParameters& settings, size_t meshes, size_t bodies,
                                 bool orders)
    : settings_(settings), orders_(orders), force_sum_(2, static_cast<Index>(bodies)) {
  sum_.resize(static_cast<Index>(meshes));
  clear();
}

void TrainStatistics::clear() {
  sum_.setZero();
  squares_ = most_ = tooth_ = share_ = parted_ = sum_;
  force_sum_.setZero();
  force_squares_ = force_most_ = VectorXd::Zero(force_sum_.cols());
  fourier_.resize(0, sum_.size());
  count_ = periods_ = 0;
}

void TrainStatistics::take(const SystemDynamics::Period& period) {
  const std::vector<Eigen::Matrix2Xd>& forces = period.bearing_force;
  const Index steps = period.mesh_force.cols();
  count_ += static_cast<double>(steps);
  if (periods_++ == 0) fourier_.setZero(resolved_harmonics(steps, kResponseHarmonics), sum_.size());
  for (Index m = 0; orders_ && m < sum_.size(); ++m)
    fourier_.col(m) +=
        fourier_coefficients(period.transmission_error.row(m).transpose(), static_cast<int>(fourier_.rows()))
            .tail(fourier_.rows());
  for (Index i = 0; i < steps; ++i) {
    carried_.assign(settings_.mesh.size(), 0.0);
    for (Index m = 0; m < sum_.size(); ++m)
      carried_[static_cast<size_t>(settings_.section[static_cast<size_t>(m)])] += period.mesh_force(m, i);
    for (Index m = 0; m < sum_.size(); ++m) {
      const double error = period.transmission_error(m, i), force = period.mesh_force(m, i),
                   all = carried_[static_cast<size_t>(settings_.section[static_cast<size_t>(m)])];
      sum_[m] += error;
      squares_[m] += error * error;
      most_[m] = std::max(most_[m], force);
      tooth_[m] = std::max(tooth_[m], period.largest_tooth_force(m, i));
      if (all > 0) share_[m] = std::max(share_[m], force / all);
      parted_[m] += period.largest_tooth_force(m, i) > 0 ? 0 : 1;
    }
  }
  for (size_t b = 0; b < forces.size(); ++b) {
    const auto body = static_cast<Index>(b);
    force_sum_.col(body) += forces[b].rowwise().sum();
    force_squares_[body] += forces[b].squaredNorm();
    force_most_[body] = std::max(force_most_[body], forces[b].colwise().norm().maxCoeff());
  }
}

VectorXd TrainStatistics::dte_rms() const {
  return oscillating_rms(sum_, squares_, count_);
}

VectorXd TrainStatistics::bearing_force_rms() const {
  return (force_squares_ / count_ - (force_sum_ / count_).colwise().squaredNorm().transpose())
      .cwiseMax(0.0)
      .cwiseSqrt();
}

}  // namespace whine
