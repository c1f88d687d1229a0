#include "dynamics/fixed_phase_motion.h"

#include <cmath>
#include <utility>

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

FixedPhaseMotion::FixedPhaseMotion(FixedPhaseMesh mesh, double step) : mesh_(std::move(mesh)) {
  const auto n = mesh_.torque.size(), strips = mesh_.gap.size();
  z = v = VectorXd::Zero(n);
  p = d = relaxed = VectorXd::Zero(strips);
  for (Eigen::Index c = 0; c < n; ++c) {
    const double w = std::sqrt(mesh_.frequency_squared[c]);
    steps_.push_back((mesh_.newmark ? newmark_propagator : exact_propagator)(w, mesh_.damping[c], step));
  }
  relaxed_step_ = relaxation_step(mesh_.relaxation, step);
  set_local(mesh_.local);
  touch();
}

void FixedPhaseMotion::set_local(const MatrixXd& local) {
  mesh_.local = local;
  compliance_ = local + relaxed_step_.from_new * mesh_.residual;
  for (size_t c = 0; c < steps_.size(); ++c) {
    const auto h = mesh_.participation.col(static_cast<Eigen::Index>(c));
    compliance_ += 0.5 * steps_[c].bq * h * h.transpose();
  }
  active_.forget();
}

void FixedPhaseMotion::start(const VectorXd& displacement, const VectorXd& load) {
  z = displacement;
  v.setZero();
  p = relaxed = load;
  d = mesh_.gap - mesh_.participation * z + mesh_.residual * relaxed + mesh_.local * p;
  force = mesh_.torque - mesh_.participation.transpose() * p;
}

void FixedPhaseMotion::touch() {
  ActiveSet active;
  solver_.solve(mesh_.local, mesh_.gap - mesh_.participation * z + mesh_.residual * relaxed, active, p, d);
  force = mesh_.torque - mesh_.participation.transpose() * p;
}

Certificate FixedPhaseMotion::advance() {
  for (size_t k = 0; k < steps_.size(); ++k) {
    const Propagator& a = steps_[k];
    const auto c = static_cast<Eigen::Index>(k);
    const double mean = 0.5 * (force[c] + mesh_.torque[c]), z0 = z[c], v0 = v[c];
    z[c] = a.a11 * z0 + a.a12 * v0 + a.bq * mean;
    v[c] = a.a21 * z0 + a.a22 * v0 + a.bv * mean;
  }
  relaxed = relaxed_step_.decay * relaxed + relaxed_step_.from_old * p;
  e_.noalias() = mesh_.gap - mesh_.participation * z;
  e_.noalias() += mesh_.residual * relaxed;
  const Certificate certificate = solver_.solve(compliance_, e_, active_, p, d);
  push_.noalias() = mesh_.participation.transpose() * p;
  for (size_t k = 0; k < steps_.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(k);
    z[c] -= 0.5 * steps_[k].bq * push_[c];
    v[c] -= 0.5 * steps_[k].bv * push_[c];
  }
  force = mesh_.torque - push_;
  relaxed += relaxed_step_.from_new * p;
  return certificate;
}

}  // namespace whine
