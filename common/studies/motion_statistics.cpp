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

template <class Forces>
void append_bearings(const Forces& of_bodies, std::vector<MatrixRM>& rows) {
  rows.resize(of_bodies.size());
  for (size_t b = 0; b < rows.size(); ++b) append(of_bodies[b], rows[b]);
}

}  // namespace

void MotionStatistics::take(const RollingDynamics::Period& period) {
  append(Eigen::MatrixXd(period.transmission_error.transpose()), error_);
  append(Eigen::MatrixXd(period.tooth_pair_load.colwise().sum()), force_);
  append(Eigen::MatrixXd(period.tooth_pair_load.colwise().maxCoeff()), tooth_);
  append_bearings(period.bearing_force, bearing_);
}

void MotionStatistics::take(const SystemDynamics::Period& period) {
  append(period.transmission_error, error_);
  append(period.mesh_force, force_);
  append(period.largest_tooth_force, tooth_);
  append_bearings(period.bearing_force, bearing_);
}

VectorXd MotionStatistics::dte_rms() const {
  VectorXd out(error_.cols());
  for (Index m = 0; m < out.size(); ++m) out[m] = oscillating_rms({error_.col(m)});
  return out;
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
