// What a sweep says, per speed.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/friction_losses.h"
#include "results/motion_model.h"
#include "results/remark.h"

namespace whine {

// response.h5: what a sweep says, per speed
struct ResponseResult : MotionParameters {
  double torque = 0;
  Direction direction = Direction::up;
  MotionModel model = MotionModel::finite_elements;
  Eigen::VectorXd mesh_frequency;     // (speed) Hz
  Eigen::VectorXd dte_rms, dte_mean;  // (speed) m
  MatrixRM dte_harmonic;              // (speed, harmonic 1..) m, amplitude
  int hunting_periods = 1;            // as in the sweep
  // (speed, order 1..) m, amplitude of the harmonics of the hunting frequency, up to those above; empty if it is the mesh
  // frequency
  MatrixRM dte_order;
  Eigen::VectorXd tooth_load_max, mesh_force_max;  // (speed) N
  // [gear] (speed) N: largest force on its bearing, and RMS of what of it oscillates; empty for a rigid bearing
  std::array<Eigen::VectorXd, 2> bearing_force_max, bearing_force_rms;
  // [gear] (speed) Pa: largest root stress, as in the sweep; empty for lumped models
  std::array<Eigen::VectorXd, 2> root_stress_max;
  // What is sustained for 1/64 of a mesh period: without the spikes of pairs that come into contact at once, whose height depends on
  // the time step. [gear] (speed) Pa; (speed) N; empty for lumped models
  std::array<Eigen::VectorXd, 2> root_stress_sustained;
  std::array<Eigen::VectorXd, 2> root_stress_angle, root_stress_phase;  // [gear] (speed) as in the sweep
  Eigen::VectorXd tooth_load_sustained, mesh_force_sustained;
  Eigen::VectorXd loss_factor;  // (speed) H_V, as in static.h5; empty without root stress
  // Flank pressure (studies/sweep_pressure.h); empty for lumped models. Places of the flanks by the phase of the pair that touches
  // there, in mesh periods from the pitch point: (place) 1; (place, gear) rad
  Eigen::VectorXd pair_phase;
  MatrixRM flank_roll;
  // (speed, place) Pa, N: largest over the mesh periods; one of the two is 0, and both where no load is sustained
  MatrixRM flank_pressure, edge_load_there;
  Eigen::VectorXd
      flank_pressure_sustained;  // (speed) Pa: sustained inside the flanks for 1/64 of a mesh period; 0: never
  std::array<Eigen::VectorXd, 2> edge_load;  // [gear] (speed) N: sustained over the gear's tip edge; 0: never
  FrictionLosses friction;
  Eigen::VectorXd separation_fraction;         // (speed) share of the period without force
  Eigen::VectorXd separations_per_period;      // (speed) 1
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  Eigen::VectorXi period_multiple;             // (speed) 1; 0: not periodic within the limit
  Eigen::VectorXd backlash_left;               // (speed) m, as in the sweep
  std::vector<Remark> remarks;                 // as in the sweep
  // what the sweep was computed with, so that a figure needs no other file
  double natural_frequency = 0;  // Hz: as in the sweep
};

}  // namespace whine
