#include "studies/motion_statistics.h"

#include "signal/rms.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Rows of the steps of a period, behind those of the periods before it.
template <class Rows>
void append(const Eigen::Ref<const Eigen::MatrixXd>& of_steps, Rows& rows) {
  const Index before = rows.rows();
  rows.conservativeResize(before + of_steps.cols(), of_steps.rows());
  rows.bottomRows(of_steps.cols()) = of_steps.transpose();
}

}  // namespace

void MotionStatistics::take(const MotionPeriod& period) {
  append(period.transmission_error, error_);
  append(period.mesh_force, force_);
  append(period.largest_tooth_force, tooth_);
  bearing_.resize(period.bearing_force.size());
  for (size_t b = 0; b < bearing_.size(); ++b) append(period.bearing_force[b], bearing_[b]);
}

VectorXd MotionStatistics::separation_fraction() const {
  VectorXd out(force_.cols());
  for (Index m = 0; m < out.size(); ++m) out[m] = separations(force_.col(m)).fraction;
  return out;
}

VectorXd MotionStatistics::bearing_force_rms() const {
  VectorXd out(static_cast<Index>(bearing_.size()));
  for (size_t b = 0; b < bearing_.size(); ++b)
    out[static_cast<Index>(b)] = bearing_[b].size() > 0 ? oscillating_vector_rms(bearing_[b]) : 0;
  return out;
}

}  // namespace whine
