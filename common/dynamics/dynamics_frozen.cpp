// The pair at a phase that does not roll: natural frequencies with its contact frozen, damping, what gear-impact moves.
#include "dynamics/dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kCounts = 0.1;  // share of the largest energy that makes a mode count, as in fit_decay

}  // namespace

// Least w^2 of z'' + (diag(frequency^2) + h^T c^-1 h) z = 0 below the first elastic frequency, without a matrix over the
// coordinates: elastic ones answer at w^2 by F = sum of h h^T / (frequency^2 - w^2), which leaves
// w^2 = h_0^T (c + F(w^2))^-1 h_0 of the rigid rotation. The right side falls with w^2.
double RollingDynamics::condensed_eigenvalue(const MatrixXd& compliance, const MatrixXd& h) const {
  const Eigen::Index n = h.cols() - 1;
  const auto elastic = h.rightCols(n);
  const double pole = frequency_squared_.tail(n).minCoeff();
  double below = 0, above = pole, at = 0;
  constexpr int kMost = 100;
  for (int k = 0; k < kMost; ++k) {
    const VectorXd response = (frequency_squared_.tail(n).array() - at).inverse();
    const MatrixXd whole = compliance + elastic * response.asDiagonal() * elastic.transpose();
    const double next = h.col(0).dot(whole.ldlt().solve(h.col(0)));
    if (std::abs(next - at) < 1e-13 * at) return next;
    (next > at ? below : above) = at;
    at = next > below && next < above ? next : 0.5 * (below + above);
  }
  fail(Failure::numerical, "no natural frequency was found below the first elastic one of ",
       std::sqrt(pole) / kTwoPi, " Hz in ", kMost,
       " steps; raise total_inertia_kgm2 or set body = \"modal\"");
}

RollingDynamics::Frozen RollingDynamics::frozen(int i, int period) {
  set_gap(i, period);
  const Position& position = positions_[i];
  const VectorXd p = equilibrium_at(position, static_compliance(i), elastic_offset(position)).p;
  std::vector<int> touch;
  for (int k = 0; k < p.size(); ++k)
    if (p[k] > 0) touch.push_back(k);
  // d = 0 on the active strips: p = (A + R)^-1 h z there, and z'' + (w^2 + h^T (A + R)^-1 h) z = 0.
  MatrixXd a = local_compliance(i);
  position.mesh.add_to_strips(position.relaxed, a);
  for (size_t j = 0; j < position.mesh.law.size(); ++j) a(j, j) += position.mesh.law[j].at(p[j]).slope;
  MatrixXd h(position.mesh.strips(), position.participation.cols());
  for (int c = 0; c < h.cols(); ++c) h.col(c) = position.mesh.to_strips(position.participation.col(c));
  return {a(touch, touch), h(touch, Eigen::all)};
}

SymmetricEigen RollingDynamics::frozen_modes(int i, const Frozen& contact, bool vectors) const {
  const MatrixXd& h = contact.participation;
  MatrixXd stiffness = h.transpose() * contact.compliance.ldlt().solve(h);
  stiffness.diagonal() += frequency_squared_;
  SymmetricEigen eigen = vectors ? symmetric_eigen(stiffness) : symmetric_eigenvalues(stiffness);
  if (!eigen.converged || !(eigen.values[0] > 0))
    fail(Failure::numerical, "at mesh phase ", positions_[i].mesh.phase, " the pair with ", h.rows(),
         " strips in contact has no natural frequency: least eigenvalue ", eigen.values[0],
         " rad2/s2 of a stiffness of norm ", stiffness.norm());
  return eigen;
}

double RollingDynamics::frozen_frequency(int i, int period) {
  const Frozen contact = frozen(i, period);
  if (full()) return std::sqrt(condensed_eigenvalue(contact.compliance, contact.participation)) / kTwoPi;
  const SymmetricEigen eigen = frozen_modes(i, contact, true);
  Eigen::Index mode = 0;
  if (floating_) {
    (eigen.vectors.transpose() * closing_weight_).cwiseAbs2().cwiseQuotient(eigen.values).maxCoeff(&mode);
  } else {
    // What a step of the torque excites of the transmission error. A body has modes that no torque moves, and they may lie lowest.
    const VectorXd amplitude = (eigen.vectors.transpose() * torque_force_)
                                   .cwiseProduct(eigen.vectors.transpose() * error_weight_)
                                   .cwiseQuotient(eigen.values);
    const VectorXd energy = amplitude.cwiseAbs2();
    for (const double most = energy.maxCoeff(); energy[mode] < kCounts * most;) ++mode;
  }
  return std::sqrt(eigen.values[mode]) / kTwoPi;
}

VectorXd RollingDynamics::frozen_frequencies(int i, int period) {
  return frozen_modes(i, frozen(i, period), false).values.cwiseSqrt() / kTwoPi;
}

MatrixXd RollingDynamics::bearing_damping() const {
  MatrixXd all = MatrixXd::Zero(frequency_squared_.size(), frequency_squared_.size());
  for (int i = 0; i < all.rows(); ++i) all(i, i) = coordinates_[i].damping;
  for (int g = 0; g < gears(); ++g) {
    const Bearing& bearing = model_.bearing[g];
    const double beside = bearing.damping - parameters_.damping.rayleigh_stiffness * bearing.stiffness;
    for (int i = sway_[g].first; i < sway_[g].first + sway_[g].count; ++i)
      for (int j = sway_[g].first; j < sway_[g].first + sway_[g].count; ++j)
        if (i != j) all(i, j) = beside * coordinates_[i].shift.dot(coordinates_[j].shift);
  }
  return all;
}

FixedPhaseMesh RollingDynamics::hold(int i) const {
  if (lines()) require_able("impact", {{Trait::lines, ""}});
  const Position& position = positions_[i];
  const MeshPosition& mesh = position.mesh;
  FixedPhaseMesh fixed;
  fixed.phase = mesh.phase;
  fixed.frequency_squared = frequency_squared_;
  fixed.damping.resize(frequency_squared_.size());
  fixed.participation.resize(mesh.strips(), frequency_squared_.size());
  for (int c = 0; c < fixed.damping.size(); ++c) {
    fixed.damping[c] = coordinates_[c].damping;
    fixed.participation.col(c) = mesh.to_strips(position.participation.col(c));
  }
  if (floating_) {
    fixed.closing_weight = closing_weight_;
    fixed.elastic = frequency_squared_;
    for (const TranslationalModes& sway : sway_)
      for (int c = sway.first; c < sway.first + sway.count; ++c) fixed.elastic[c] = coordinates_[c].elastic;
  }
  fixed.torque = torque_force_;
  fixed.error_weight = error_weight_;
  fixed.local = local_compliance(i);
  fixed.residual = MatrixXd::Zero(mesh.strips(), mesh.strips());
  mesh.add_to_strips(position.relaxed, fixed.residual);
  fixed.gap = mesh.gap;
  fixed.first_strip = mesh.first_strip;
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    if (!mesh.pairs[j].low_is_edge) fixed.zone_end.push_back(mesh.first_strip[j]);
    if (!mesh.pairs[j].high_is_edge) fixed.zone_end.push_back(mesh.first_strip[j + 1] - 1);
  }
  fixed.next_corner_gap = mesh.next_corner_gap;
  fixed.lost_corner_gap = mesh.lost_corner_gap;
  fixed.relaxation = relaxation();
  fixed.newmark = newmark_;
  return fixed;
}

}  // namespace whine
