#include "system/face_record.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// m2 N-1: of local compliance (at the forces that it carries) and bodies between line loads, W^1/2 (C + law') W^1/2 with the weights W.
double least_eigenvalue(const FacePoints& points, const std::vector<HertzLine>& law,
                        const Eigen::Ref<const VectorXd>& force,
                        const Eigen::Ref<const MatrixXd>& compliance) {
  MatrixXd whole = compliance;
  for (Index q = 0; q < points.size(); ++q) whole(q, q) += law[static_cast<size_t>(q)].at(force[q]).slope;
  const VectorXd root = points.weight.cwiseSqrt();
  whole = root.asDiagonal() * whole * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(whole, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace

FaceRecord::FaceRecord(const FaceContact& contact) : contact_(&contact), roots_(contact) {
  face_.least_eigenvalue = std::numeric_limits<double>::infinity();
}

void FaceRecord::take(Index row, const FaceMesh& mesh, const std::vector<HertzLine>& law,
                      const Eigen::Ref<const VectorXd>& force, const Eigen::Ref<const MatrixXd>& compliance) {
  const FacePoints& points = mesh.points;
  rows_.resize(std::max(rows_.size(), static_cast<size_t>(row) + 1));
  rows_[static_cast<size_t>(row)] = {points, force, {}};
  if (roots_.known()) rows_[static_cast<size_t>(row)].load = roots_.loads(mesh, force);
  face_.least_eigenvalue = std::min(face_.least_eigenvalue, least_eigenvalue(points, law, force, compliance));
  const GearPair& gears = contact_->gears();
  for (Index q = 0; q < points.size(); ++q) {
    lost_ +=
        force[q] * std::abs(gears.sliding(std::clamp(points.path[q], gears.path_start(), gears.path_end())));
    if (!(force[q] > 0) || !contact_->inside(points.path[q], points.z[q])) continue;
    face_.line_load_max = std::max(face_.line_load_max, force[q] / points.weight[q]);
    face_.half_width_max = std::max(face_.half_width_max, 0.5 * law[static_cast<size_t>(q)].width(force[q]));
  }
}

void FaceRecord::finish(StaticResult& result) const {
  FaceLoad& face = result.face = face_;
  const GearPair& gears = contact_->gears();
  const double cosine = std::cos(gears.base_helix_angle());
  const int n = contact_->points();
  if (!(face.least_eigenvalue > 0))
    fail(Failure::numerical, "at ", result.torque, " N m the compliance of ", n,
         " points along each line and polynomials to degree ", contact_->degree(),
         " is not positive definite (least eigenvalue ", face.least_eigenvalue,
         " m2/N); write a smaller width_degree in [discretisation], or another number of face_points");
  for (std::vector<MatrixRM>* list : {&face.line_load, &face.position, &face.width})
    list->assign(rows_.size(), MatrixRM::Zero(result.pair.size(), n));
  face.contact_line_length.setZero(static_cast<Index>(rows_.size()));
  for (size_t i = 0; i < rows_.size(); ++i) {
    const FacePoints& points = rows_[i].points;
    for (Index line = 0; line < static_cast<Index>(points.line.size()); ++line) {
      const ContactLine& at = points.line[static_cast<size_t>(line)];
      const auto own = Eigen::seqN(line * n, n);
      const Index k = at.pair - result.pair[0];
      face.line_load[i].row(k) = rows_[i].force(own).cwiseQuotient(points.weight(own)).transpose();
      face.position[i].row(k) = points.z(own).transpose();
      face.width[i].row(k) = points.weight(own).transpose();
      face.contact_line_length[static_cast<Index>(i)] += at.length() / cosine;
    }
  }
  if (roots_.known()) finish_roots(result);
  face.overlap_ratio = gears.overlap_ratio();
  face.axial_force = helical_forces(gears, result.torque).axial;
  face.degree = contact_->degree();
  if (result.torque > 0) result.loss_factor = lost_ / (static_cast<double>(rows_.size()) * result.torque);
}

void FaceRecord::finish_roots(StaticResult& result) const {
  FaceLoad& face = result.face;
  const Index phases = static_cast<Index>(rows_.size()), pairs = result.pair.size();
  for (VectorXd* v : {&result.root_stress_max, &result.root_stress_angle, &result.root_stress_phase,
                      &face.load_factor_root, &face.root_stress_error})
    v->setZero(kSides);
  for (int g = 0; g < kSides; ++g) {
    const auto side = static_cast<size_t>(g);
    face.root_position[side] = roots_.position(side);
    face.root_stress[side].assign(rows_.size(), MatrixRM::Zero(pairs, kFaceStations));
    result.root_stress[side] = MatrixRM::Zero(phases, pairs);
    for (Index i = 0; i < phases; ++i) {
      const Row& row = rows_[static_cast<size_t>(i)];
      for (Index k = 0; k < pairs; ++k) {
        const RootOverFace tooth = roots_.of_tooth(side, result.pair[k], row.points.line, row.load[side]);
        face.root_stress[side][static_cast<size_t>(i)].row(k) = tooth.stress.transpose();
        result.root_stress[side](i, k) = tooth.most.stress;
        if (tooth.most.stress <= result.root_stress_max[g]) continue;
        result.root_stress_max[g] = tooth.most.stress;
        result.root_stress_angle[g] = tooth.most.angle;
        result.root_stress_phase[g] =
            result.mesh_phase[i] - std::floor(result.mesh_phase[i]) + result.pair[k];
        face.load_factor_root[g] = roots_.load_factor(side, tooth);
      }
    }
  }
}

double load_factor(const FaceContact& contact, const FacePoints& points, double phase,
                   const Eigen::Ref<const VectorXd>& force) {
  const int n = points.per_line;
  Index nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Index line = 0; line < static_cast<Index>(points.line.size()); ++line)
    if (const double away = std::abs(phase + points.line[static_cast<size_t>(line)].pair);
        away < least && force.segment(line * n, n).sum() > 0) {
      least = away;
      nearest = line;
    }
  if (nearest < 0) return 0;
  const auto own = Eigen::seqN(nearest * n, n);
  const VectorXd load = force(own).cwiseQuotient(points.weight(own));
  return face_load_factor(points.z(own), points.weight(own), load, points.line[static_cast<size_t>(nearest)],
                          contact.degree() > 0 ? kInnerFace : 1);
}

}  // namespace whine
