// What a motion of a train shows over its periods: of each mesh and each bearing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "dynamics/system_dynamics.h"
#include "model/system_stages.h"

namespace whine {

class TrainStatistics {
 public:
  // settings: lives as long as this. orders: whether dte_harmonic() is asked for.
  TrainStatistics(const SystemStaticParameters& settings, size_t meshes, size_t bodies, bool orders = false);
  void clear();
  void take(const SystemDynamics::Period& period);
  // Over all steps of the periods taken. (mesh)
  Eigen::VectorXd dte_mean() const { return sum_ / count_; }  // m
  Eigen::VectorXd dte_rms() const;                            // m, of the oscillating part
  // (harmonic 1.., mesh) m: amplitudes of the mesh frequency's harmonics, those that the samples of a period resolve, ten at most.
  Eigen::MatrixXd dte_harmonic() const { return 2 / periods_ * fourier_.cwiseAbs(); }
  const Eigen::VectorXd& mesh_force_max() const { return most_; }
  const Eigen::VectorXd& tooth_force_max() const { return tooth_; }        // N, of one pair of teeth
  Eigen::VectorXd load_share_max() const { return share_.cwiseMin(1.0); }  // of the meshes of its section
  Eigen::VectorXd separation_fraction() const { return parted_ / count_; }
  // (body) N
  const Eigen::VectorXd& bearing_force_max() const { return force_most_; }
  Eigen::VectorXd bearing_force_rms() const;  // of the oscillating part

 private:
  const SystemStaticParameters& settings_;
  bool orders_;
  std::vector<double> carried_;  // [[[mesh]]] N: of all its meshes
  Eigen::VectorXd sum_, squares_, most_, tooth_, share_, parted_;
  Eigen::MatrixXd force_sum_;
  Eigen::VectorXd force_squares_, force_most_;
  Eigen::MatrixXcd fourier_;  // (harmonic 1.., mesh) sum over the periods
  double count_ = 0, periods_ = 0;
};

}  // namespace whine
