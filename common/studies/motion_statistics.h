// What a motion shows over all steps of its periods: of each mesh and each bearing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/matrix.h"
#include "dynamics/motion_period.h"
#include "signal/spectrum.h"

namespace whine {

class MotionStatistics {
 public:
  void clear() { *this = {}; }
  void take(const MotionPeriod& period);
  // Of the transmission error of a mesh, of `periods` mesh periods that were taken.
  Harmonics dte(Eigen::Index mesh, int count, int periods) const {
    return harmonics(error_.col(mesh), count, periods);
  }
  Eigen::VectorXd mesh_force_max() const { return force_.colwise().maxCoeff().transpose(); }  // (mesh) N
  Eigen::VectorXd tooth_load_max() const {
    return tooth_.colwise().maxCoeff().transpose();
  }                                             // (mesh) N, of one tooth pair
  Eigen::VectorXd separation_fraction() const;  // (mesh) 1
  // (body) N, of the part that oscillates; 0 of a rigid bearing of a pair
  Eigen::VectorXd bearing_force_rms() const;

 private:
  Eigen::MatrixXd error_, force_, tooth_;  // (step, mesh)
  std::vector<MatrixRM> bearing_;          // [body] (step, xy) N
};

}  // namespace whine
