#include "gear/losses.h"

#include <algorithm>
#include <cmath>

namespace whine {

double loss_factor(const GearPair& pair, const Eigen::VectorXi& number, const Eigen::VectorXd& phase,
                   const Eigen::Ref<const MatrixRM>& load, double torque) {
  double lost = 0;  // N m rad-1
  for (Eigen::Index i = 0; i < load.rows(); ++i)
    for (Eigen::Index k = 0; k < load.cols(); ++k) {
      if (!(load(i, k) > 0)) continue;
      const double path = std::clamp((phase[i] - std::floor(phase[i]) + number[k]) * pair.base_pitch(),
                                     pair.path_start(), pair.path_end());
      lost += load(i, k) * std::abs(pair.sliding(path));
    }
  return lost / (static_cast<double>(load.rows()) * torque);
}

}  // namespace whine
