// Where the energy of an integrated mesh period of a system goes; as energy_balance.h, of each mesh, drive and bearing.
#pragma once
#include <Eigen/Core>

namespace whine {

// J, summed over the steps of a period. Every line is computed by itself, none as what is left of the others:
//   d(kinetic + modal + residual + local) + modal_damping + bearing_damping + relaxation_damping + friction
//     = drive + rolling + friction_rolling + centrifugal + dragging + switching + cutting + dropped - averaging.
struct SystemEnergyBalance {
  // Changes of what is stored: motion; kept modes and bearings; residual flexibility; Hertz's laws and all that is instantaneous.
  double kinetic = 0, modal = 0, residual = 0, local = 0;
  Eigen::VectorXd drive;    // (body) work of its torque on the vibration
  Eigen::VectorXd rolling;  // (mesh) of the prescribed rolling
  // Of the frame where it turns: of centrifugal forces, the change of their potential; (body) of dampers on the ground, which see it go by.
  // Coriolis forces do no work.
  double centrifugal = 0;
  Eigen::VectorXd dragging;
  double modal_damping = 0;         // Rayleigh's, and the dampers of the axes
  Eigen::VectorXd bearing_damping;  // (body)
  double relaxation_damping = 0;
  Eigen::VectorXd switching;  // (mesh) of the scheme, see EnergyBalance
  Eigen::VectorXd cutting;    // (mesh) pairs that a corner rule removes or adds while they carry force
  double averaging = 0;       // of the scheme
  // Relaxed loads of teeth that are no longer followed; the renaming of teeth adds the same to `residual`, so that it is not checked.
  // And -p . d / 2 of a start that violates the contact conditions. p . d of the steps themselves is imbalance.
  double dropped = 0;
  // (mesh) all that friction takes, integral of mu s N v of the kinematics with the vibration in v. friction_rolling: work of the
  // prescribed rolling against it, from torques and angular momenta: each gear turns by w_b against
  //   T_b + D_b - N_b - dL_b/dt,
  // N_b the moment of the normal forces, L_b = I_b theta_b' of the rigid rotations, less what the dampers of the axes take. D_b holds the
  // mean speed of a train that can roll, along I_b times its rolling, and follows from one gear for each rolling: of that gear, and of
  // bodies that are held, the moment of friction itself stands there. No sliding speed is in it.
  Eigen::VectorXd friction;
  double friction_rolling = 0;
  double throughput = 0;  // sum of |drive| + |rolling| + |friction_rolling| per step
  double imbalance = 0;   // largest |sum of the lines so far|
};

}  // namespace whine
