// Where the primary resonance of a pair has two branches, against damping.
#pragma once
#include <Eigen/Core>
#include <array>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/motion_model.h"

namespace whine {

// jump_map.h5: where the primary resonance of a pair has two branches, and what its teeth then carry, at one torque for
// several dampings ("cases"). Speeds ascend; direction 0 is up, 1 down.
struct JumpMapResult : MotionParameters {
  MotionModel model = MotionModel::finite_elements;
  DamperActs damper_acts = DamperActs::always;  // of lumped models
  double torque = 0;                            // N m on the driver
  double bearing_stiffness = 0;                 // N m-1 that sets the bearing dampers
  double mean_stiffness = 0;                    // N m-1: secant, at rest
  double first_harmonic = 0;                    // N m-1: amplitude, of the secant stiffness at rest
  double two_pair_frequency = 0;                // Hz, contact frozen, undamped, amid the state of two pairs
  double one_pair_frequency = 0;  // Hz: the same for one pair; 0 if one pair alone never carries the load
  Eigen::VectorXd rayleigh_stiffness, damping_ratio;  // (case) s, 1: of two pairs, contact frozen
  Eigen::VectorXi two_branches;                       // (case) 1 if speeds with two motions were found
  Eigen::VectorXd branches_from, branches_to;         // (case) Hz: ends of that range; 0 without one
  Eigen::VectorXi open_below;                         // (case) 1: the range goes on below the least speed
  Eigen::VectorXd loss_from, loss_to;  // (case) Hz: speeds that lose contact, on any branch; 0 without
  Eigen::VectorXd excitation;          // (case) first harmonic / mean stiffness / (2 damping ratio)
  MatrixRM peak_tooth_load;            // (case, direction) N: largest of all speeds
  // (case, direction) N: the same sustained for 1/64 of a mesh period: without the spike of a pair that comes into contact at
  // once, whose height depends on the time step
  MatrixRM sustained_tooth_load;
  double load_frequency = 0;  // Hz: the one speed of the next three; 0: none was asked for
  MatrixRM tooth_load, sustained_load_there, dte_rms_there;  // (case, direction) N, N, m
  Eigen::VectorXi unsteady;  // (case) speeds and directions at which no steady motion was found
  Eigen::VectorXi jump_case, jump_direction;   // (jump)
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  Eigen::VectorXd mesh_frequency;              // (speed) Hz
  // [direction] (case, speed) m, N, 1: share of the period without force
  std::array<MatrixRM, 2> dte_rms, tooth_load_max, separation_fraction;
};

}  // namespace whine
