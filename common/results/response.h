// What a sweep says, per speed: of a pair or of a train.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "results/friction_losses.h"
#include "results/motion_model.h"
#include "results/motion_source.h"
#include "results/remark.h"

namespace whine {

// response.h5: what a sweep says, per speed, of each mesh and each body. A pair has one mesh and two bodies, driver and driven.
struct ResponseResult : MotionSource {
  Direction direction = Direction::up;
  MotionModel model = MotionModel::finite_elements;
  Eigen::VectorXd mesh_frequency;      // (speed) Hz
  MatrixRM dte_rms, dte_mean;          // (speed, mesh) m
  std::vector<MatrixRM> dte_harmonic;  // [speed] (harmonic 1.., mesh) m, amplitude
  Eigen::Index harmonics() const { return dte_harmonic.empty() ? 0 : dte_harmonic[0].rows(); }
  int hunting_periods = 1;  // as in the sweep
  // [speed] (order 1.., mesh) m, amplitude of the harmonics of the hunting frequency, up to those above; empty if it is the mesh
  // frequency
  std::vector<MatrixRM> dte_order;
  // (speed, mesh) of the residual signal, the transmission error less the mean of its mesh periods: RMS in m; kurtosis, 3 of noise,
  // the more the fewer teeth make it. Empty if the hunting frequency is the mesh frequency
  MatrixRM residual_rms, residual_kurtosis;
  MatrixRM tooth_load_max, mesh_force_max;    // (speed, mesh) N
  std::vector<MatrixRM> mesh_force_harmonic;  // [speed] (harmonic 1.., mesh) N, amplitude
  // (speed, mesh) 1: largest share, at one instant, of the meshes that come from one [[mesh]]; empty unless one has several
  MatrixRM load_share_max;
  MatrixRM face_load_factor, line_load_max;  // (speed, mesh) as in the sweep
  MatrixRM separation_fraction;              // (speed, mesh) share of the period without force
  MatrixRM separations_per_period;           // (speed, mesh) 1
  // (speed, body) N: largest force on its bearing, and RMS of what of it oscillates; 0 of the gears of a pair on rigid bearings,
  // empty if both are
  MatrixRM bearing_force_max, bearing_force_rms;
  // [speed] (harmonic 1.., body) N: amplitude of that force, x and y together, the root of the sum of their squares
  std::vector<MatrixRM> bearing_force_harmonic;
  // (speed, mesh and within it side) Pa: largest root stress, as in the sweep; 0 of a mesh of which it is not known, empty if it is of
  // none. So are the next ones.
  MatrixRM root_stress_max;
  // What is sustained for 1/64 of a mesh period: without the spikes of pairs that come into contact at once, whose height depends on
  // the time step. (speed, mesh and within it side) Pa; (speed, mesh) N
  MatrixRM root_stress_sustained;
  MatrixRM root_stress_angle, root_stress_phase;  // as in the sweep
  MatrixRM tooth_load_sustained, mesh_force_sustained;
  Eigen::VectorXd loss_factor;  // (speed) H_V of a pair, as in static.h5; empty without root stress
  // Flank pressure (studies/sweep_pressure.h); empty for lumped models. Places of the flanks by the phase of the pair that touches
  // there, in mesh periods from the pitch point: (place) 1; (place, gear) rad
  Eigen::VectorXd pair_phase;
  MatrixRM flank_roll;
  // (speed, place) Pa, N: largest over the mesh periods; one of the two is 0, and both where no load is sustained
  MatrixRM flank_pressure, edge_load_there;
  Eigen::VectorXd
      flank_pressure_sustained;  // (speed) Pa: sustained inside the flanks for 1/64 of a mesh period; 0: never
  MatrixRM edge_load;            // (speed, body) N: sustained over the gear's tip edge; 0: never
  FrictionLosses friction;
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  Eigen::VectorXi periods;                     // (speed) mesh periods run
  Eigen::VectorXi period_multiple;             // (speed) 1; 0: not periodic within the limit
  Eigen::VectorXd energy_imbalance;            // (speed) as in the sweep
  Eigen::VectorXd backlash_left;               // (speed) m, as in the sweep
  std::vector<Remark> remarks;                 // as in the sweep
  // what the sweep was computed with, so that a figure needs no other file
  double natural_frequency = 0;  // Hz: as in the sweep, of pairs
};

// Whether values (speed, body), or (speed, mesh and within it side), hold something in this column: elsewhere they are 0.
inline bool known_of(const MatrixRM& values, Eigen::Index column) {
  return values.size() > 0 && values.col(column).maxCoeff() > 0;
}

}  // namespace whine
