#include "solid/width_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/error.h"
#include "base/legendre.h"

namespace whine {

Eigen::VectorXd plane_share(double base_radius, double helix, const Eigen::VectorXd& xi) {
  return (1 + (helix * base_radius) * (helix * base_radius) * (1 + xi.array().square())).rsqrt();
}

int degree_of_contact(double face_width, double half_width) {
  return static_cast<int>(std::min<double>(kLargestDegree, std::sqrt(face_width / (2 * half_width))));
}

WidthTables cut_to_degree(const WidthTables& tables, int degree) {
  if (degree == tables.degree) return tables;
  WidthTables out = tables;
  out.degree = degree;
  const Eigen::Index all = tables.degree + 1, own = degree + 1;
  for (std::vector<MatrixRM>* list : {&out.flexibility, &out.root_stress})
    for (MatrixRM& table : *list) {
      const MatrixRM whole = table;
      table.resize(whole.rows() / all * own, whole.cols() / all * own);
      for (Eigen::Index a = 0; a < whole.rows() / all; ++a)
        for (Eigen::Index b = 0; b < whole.cols() / all; ++b)
          table.block(a * own, b * own, own, own) = whole.block(a * all, b * all, own, own);
    }
  return out;
}

WidthKernel::WidthKernel(const ToothGeometry& tooth, WidthTables tables)
    : tables_(std::move(tables)), flank_(tooth, static_cast<int>(tables_.flank_position.size())) {
  const Eigen::Index points = flank_.size(), all = tables_.degree + 1, size = points * all;
  if (tables_.flexibility.empty() || tables_.flexibility[0].rows() != size ||
      tables_.flexibility[0].cols() != size || !flank_.points().isApprox(tables_.flank_position, 1e-9))
    fail(Failure::input, "tables over the face width of ", points, " flank points and degree ",
         tables_.degree, " are not of this tooth; reduce the body anew");
  completed_ = tables_.flexibility[0];
  completion_ = MatrixRM::Zero(points, points);
  for (Eigen::Index a = 0; a < points; ++a)
    for (Eigen::Index b = 0; b < points; ++b) {
      const auto dc = [&](Eigen::Index j) -> double& { return completed_(a * all + j, b * all + j); };
      if (all > 1) completion_(a, b) = 0.5 * (dc(all - 1) + dc(all - 2));
      for (Eigen::Index j = 0; j < all; ++j) dc(j) -= completion_(a, b);
    }
}

Eigen::MatrixXd WidthKernel::coupling(double xi_read, double xi_load, int tooth_offset) const {
  const Eigen::Index all = tables_.degree + 1;
  // Columns: the functional of each polynomial.
  const auto functionals = [&](double xi) {
    const Eigen::RowVectorXd along = flank_.weights(xi);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(along.size() * all, all);
    for (Eigen::Index p = 0; p < along.size(); ++p)
      columns.middleRows(p * all, all).diagonal().setConstant(along[p]);
    return columns;
  };
  Eigen::MatrixXd result = between(functionals(xi_read), functionals(xi_load), tooth_offset);
  if (tooth_offset == 0) result.diagonal().array() += completion(xi_read, xi_load);
  return result;
}

double WidthKernel::completion(double xi_read, double xi_load) const {
  return flank_.weights(xi_read) * completion_ * flank_.weights(xi_load).transpose();
}

Eigen::VectorXd WidthKernel::point(double xi, double z) const {
  const Eigen::RowVectorXd along = flank_.weights(xi);
  const Eigen::VectorXd over = face_polynomials(z, tables_.face_width, tables_.degree);
  Eigen::VectorXd result(along.size() * over.size());
  for (Eigen::Index p = 0; p < along.size(); ++p)
    result.segment(p * over.size(), over.size()) = along[p] * over;
  return result;
}

Eigen::MatrixXd WidthKernel::between(const Eigen::MatrixXd& read, const Eigen::MatrixXd& load,
                                     int tooth_offset) const {
  if (std::abs(tooth_offset) > offsets())
    fail(Failure::input, "tables over the face width reach ", offsets(), " teeth, not ", tooth_offset);
  if (tooth_offset == 0) return read.transpose() * (completed_ * load);
  // The tooth d clockwise of the loaded one: by reciprocity.
  const MatrixRM& table = tables_.flexibility[static_cast<size_t>(std::abs(tooth_offset))];
  if (tooth_offset < 0) return (load.transpose() * (table * read)).transpose();
  return read.transpose() * (table * load);
}

}  // namespace whine
