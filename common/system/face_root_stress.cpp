#include "system/face_root_stress.h"

#include <cmath>
#include <cstdlib>

#include "base/legendre.h"
#include "results/static.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd stations(double face_width) {
  return VectorXd::LinSpaced(kFaceStations, -0.5 * face_width, 0.5 * face_width);
}

}  // namespace

FaceRootStresses::FaceRootStresses(const FaceContact& contact) : contact_(&contact), known_(true) {
  for (size_t g = 0; g < kSides; ++g) {
    const WidthKernel* kernel = contact.kernel(g);
    known_ = known_ && kernel && !kernel->tables().root_stress.empty();
    if (!known_) return;
    const double width = kernel->tables().face_width;
    const VectorXd z = stations(width);
    polynomials_[g].resize(kernel->degree() + 1, kFaceStations);
    for (Index k = 0; k < z.size(); ++k)
      polynomials_[g].col(k) = face_polynomials(z[k], width, kernel->degree());
  }
}

VectorXd FaceRootStresses::position(size_t g) const {
  return stations(contact_->kernel(g)->tables().face_width).array() - contact_->middle(g);
}

std::array<MatrixXd, 2> FaceRootStresses::loads(const FaceMesh& mesh,
                                                const Eigen::Ref<const VectorXd>& force) const {
  std::array<MatrixXd, 2> out;
  const FacePoints& points = mesh.points;
  for (size_t g = 0; g < kSides; ++g) {
    const WidthKernel& kernel = *contact_->kernel(g);
    out[g].setZero(kernel.tables().flexibility[0].cols(), static_cast<Index>(points.line.size()));
    for (int q = 0; q < points.size(); ++q)
      if (force[q] > 0)
        out[g].col(points.line_of(q)) +=
            force[q] * kernel.point(mesh.roll[g][q], points.z[q] + contact_->middle(g));
  }
  return out;
}

RootOverFace FaceRootStresses::of_tooth(size_t g, int of, const std::vector<ContactLine>& line,
                                        const MatrixXd& load) const {
  const WidthKernel& kernel = *contact_->kernel(g);
  const VectorXd& angle = contact_->mesh().gear[g].body().root_angle;
  VectorXd sum = VectorXd::Zero(kernel.tables().root_stress[0].rows());
  for (size_t p = 0; p < line.size(); ++p) {
    const int offset = GearMeshModel::tooth(static_cast<int>(g), of - line[p].pair);
    if (std::abs(offset) <= kernel.offsets())
      sum += kernel.root_stress(offset) * load.col(static_cast<Index>(p));
  }
  // (root, station)
  const MatrixXd along = sum.reshaped<Eigen::RowMajor>(angle.size(), kernel.degree() + 1) * polynomials_[g];
  RootOverFace out{VectorXd(kFaceStations), {0, of, 0}};
  for (Index k = 0; k < kFaceStations; ++k) {
    const RootStress here = largest_along(along.col(k), angle, of);
    out.stress[k] = here.stress;
    const double place = 2.0 * static_cast<double>(k) / (kFaceStations - 1) - 1;
    if (std::abs(place) <= kClearOfCorners && here.stress > out.most.stress) out.most = here;
  }
  return out;
}

double FaceRootStresses::load_factor(size_t g, const RootOverFace& tooth) const {
  const VectorXd z = position(g);
  const double half = 0.5 * contact_->gears().face_width() * (1 + 1e-9);
  double sum = 0;
  int count = 0;
  for (Index k = 0; k < z.size(); ++k)
    if (std::abs(z[k]) <= half) {
      sum += tooth.stress[k];
      ++count;
    }
  return sum > 0 ? tooth.most.stress * count / sum : 0;
}

}  // namespace whine
