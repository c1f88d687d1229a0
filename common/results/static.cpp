#include "results/static.h"

#include <algorithm>
#include <cmath>

namespace whine {

double torque_of(const SystemStaticResult& rest) {
  if (!rest.of_train()) return rest.mesh.at(0).torque;
  double most = 0;
  for (Eigen::Index b = 0; b < rest.torque.cols(); ++b)
    if (!rest.settings.layout.held(static_cast<int>(b))) most = std::max(most, rest.torque.col(b).mean());
  return std::round(most * 1e6) * 1e-6;
}

}  // namespace whine
