// What a motion of a train shows over all steps of its periods: of each mesh and each bearing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/matrix.h"
#include "dynamics/system_dynamics.h"

namespace whine {

class TrainStatistics {
 public:
  void clear() { *this = {}; }
  void take(const SystemDynamics::Period& period);
  // (mesh) m; of the part that oscillates
  Eigen::VectorXd dte_rms() const;
  Eigen::VectorXd dte_mean() const { return error_.colwise().mean().transpose(); }
  Eigen::VectorXd mesh_force_max() const { return force_.colwise().maxCoeff().transpose(); }  // N
  Eigen::VectorXd tooth_load_max() const {
    return tooth_.colwise().maxCoeff().transpose();
  }  // N, of one pair of teeth
  Eigen::VectorXd separation_fraction() const;
  Eigen::VectorXd bearing_force_rms() const;  // (body) N, of the part that oscillates

 private:
  Eigen::MatrixXd error_, force_, tooth_;  // (step, mesh)
  std::vector<MatrixRM> bearing_;          // [body] (step, xy) N
};

}  // namespace whine
