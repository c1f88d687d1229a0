#include "system/face_points.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "gear/face_width.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

int face_points_of(const std::vector<GearMeshSpec>& meshes, const ContactDiscretisation& contact) {
  if (contact.face_points > 0) return contact.face_points;
  const bool uneven =
      std::any_of(meshes.begin(), meshes.end(), [](const GearMeshSpec& mesh) { return mesh.uneven(); });
  return uneven ? kFacePointsUneven : kFacePoints;
}

FaceGap::FaceGap(const GearPair& pair, const GearMeshSpec& mesh)
    : middle_(contact_middle(pair.gear(0).design(), pair.gear(1).design(), mesh.face_offset)),
      slope_(mesh.misalignment / pair.face_width()),
      none_(!mesh.uneven()) {
  for (int g = 0; g < kSides; ++g)
    lead_[static_cast<size_t>(g)] =
        LeadDeviation(mesh.modification[static_cast<size_t>(g)].lead, pair.gear(g).design().face_width);
}

FacePoints face_points(const GearPair& pair, const FaceGap& gap, const std::vector<ContactLine>& lines,
                       double phase, const GaussRule& rule) {
  const auto per_line = static_cast<int>(rule.point.size());
  FacePoints out;
  out.line = lines;
  out.per_line = per_line;
  const auto size = static_cast<Index>(lines.size()) * per_line;
  for (VectorXd* v : {&out.z, &out.weight, &out.path, &out.gap}) v->resize(size);
  Index at = 0;
  for (const ContactLine& line : lines)
    for (int i = 0; i < per_line; ++i, ++at) {
      out.z[at] = 0.5 * (line.from + line.to + line.length() * rule.point[i]);
      out.weight[at] = 0.5 * line.length() * rule.weight[i];
      out.path[at] = path_at(pair, phase + line.pair, out.z[at]);
      out.gap[at] = gap.at(out.z[at]);
    }
  return out;
}

Eigen::RowVectorXd interpolation(const FacePoints& points, int line, double z) {
  const int n = points.per_line;
  const auto own = points.z.segment(static_cast<Index>(line) * n, n);
  Eigen::RowVectorXd value(n);
  for (int a = 0; a < n; ++a) {
    double product = 1;
    for (int b = 0; b < n; ++b)
      if (b != a) product *= (z - own[b]) / (own[a] - own[b]);
    value[a] = product;
  }
  return value;
}

namespace {

// At x, of the parabola through three points.
double parabola(const Eigen::Vector3d& at, const Eigen::Vector3d& value, double x) {
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    sum += value[a] * (x - at[b]) * (x - at[c]) / ((at[a] - at[b]) * (at[a] - at[c]));
  }
  return sum;
}

// At x, of the cubic with the least weighted squares from values above 0; below five of them a polynomial of two degrees less than there are.
double smoothed(const VectorXd& at, const VectorXd& value, const VectorXd& weight, double x) {
  constexpr Index kTerms = 4;
  const Index terms = std::min(kTerms, (value.array() > 0).count() - 1);
  if (terms < 1) return 0;
  const double scale = at.cwiseAbs().maxCoeff();
  MatrixXd powers = MatrixXd::Ones(at.size(), terms);
  for (Index j = 1; j < terms; ++j) powers.col(j) = powers.col(j - 1).cwiseProduct(at) / scale;
  const VectorXd root = (value.array() > 0).select(weight, 0).cwiseSqrt();
  const VectorXd factor =
      least_squares(MatrixXd(root.asDiagonal() * powers), MatrixXd(root.cwiseProduct(value)));
  double sum = 0;
  for (Index j = terms - 1; j >= 0; --j) sum = sum * x / scale + factor[j];
  return sum;
}

}  // namespace

double face_load_factor(const Eigen::Ref<const VectorXd>& z, const Eigen::Ref<const VectorXd>& weight,
                        const Eigen::Ref<const VectorXd>& load, const ContactLine& line, double inner) {
  const double mean = load.dot(weight) / line.length(), middle = 0.5 * (line.from + line.to),
               reach = 0.5 * inner * line.length();
  Index first = 0, count = z.size();
  while (count > 3 && std::abs(z[first] - middle) > reach) {  // the rule is symmetric
    ++first;
    count -= 2;
  }
  const VectorXd at = z.segment(first, count), own = load.segment(first, count);
  const double most = own.maxCoeff();
  if (count < 3) return most / mean;
  if (inner == 1)
    return std::max({most, parabola(at.head(3), own.head(3), line.from),
                     parabola(at.tail(3), own.tail(3), line.to)}) /
           mean;
  const auto carried = [&](Index outermost, double end) {
    if (!(own[outermost] > 0)) return 0.0;
    return smoothed(at.array() - middle, own, weight.segment(first, count), end - middle);
  };
  return std::max({most, carried(0, line.from), carried(count - 1, line.to)}) / mean;
}

}  // namespace whine
