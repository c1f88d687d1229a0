// A_local (Eq. 17): the half-planes under the strips.
#include "system/rolling_mesh.h"

namespace whine {

using Eigen::MatrixXd;

MatrixXd local_compliance(const GearMeshModel& model, const MeshPosition& position, double depth) {
  MatrixXd a = MatrixXd::Zero(position.strips(), position.strips());
  if (!position.law.empty()) return a;
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const int first = position.first_strip[j], n = position.pairs[j].size();
    a.block(first, first, n, n) = half_plane_compliance(position.pairs[j], model.gear[0].half_plane(),
                                                        model.gear[1].half_plane(), depth);
  }
  return a;
}

}  // namespace whine
