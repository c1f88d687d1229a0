// Where the energy of integrated mesh periods goes, of each mesh and each body.
#pragma once
#include <Eigen/Core>

namespace whine {

// J, summed over the steps of the periods that it records. Every line is computed by itself, none as what is left of the others. With mean
// forces p' = (p_n + p_n+1)/2:
//   d(storage) + modal_damping + bearing_damping + relaxation_damping + friction
//     = drive + rolling + friction_rolling + centrifugal + dragging + switching + cutting + dropped - averaging.
// A pair on strips has one mesh and two bodies; its torques act on one rotation, and `drive` of the driver holds the work of both.
struct EnergyBalance {
  // Change of: energy of motion; of the springs of kept modes and bearings; of the residual flexibility; of half-planes, Hertz's laws and all
  // else that is instantaneous.
  double kinetic = 0, modal = 0, residual = 0, local = 0;
  Eigen::VectorXd drive;  // (body) work of the constant torques on the vibration
  Eigen::VectorXd
      rolling;  // (mesh) of the prescribed rolling: gaps, participation and compliance change with phase
  // Of the frame where it turns: of centrifugal forces, the change of their potential; (body) of dampers on the ground, which see it go by.
  // Coriolis forces do no work.
  double centrifugal = 0;
  Eigen::VectorXd dragging;
  // By quadrature of v^2: Rayleigh's dampers and those of the axes, of strips those of bearings, too; (body) of bearings and pins, 0 of
  // strips.
  double modal_damping = 0;
  Eigen::VectorXd bearing_damping;
  double relaxation_damping = 0;  // of the residual flexibility, by quadrature
  // (mesh) The scheme's own: strips or lines that open or close within a step, (p_n d_n+1 - p_n+1 d_n) / 2, and what the
  // trapezoid of force over indentation misses of the energy of a line's bent law.
  Eigen::VectorXd switching;
  Eigen::VectorXd cutting;  // (mesh) pairs that a corner rule takes out, or lets in, while they carry force
  double averaging = 0;  // the scheme's own: mean load times change of the relaxed load, less the exact work
  // The relaxed load of a tooth that is no longer followed, about a mesh period after its load: minus the energy G R G / 2
  // that goes with it, plus the work of the mean contact forces on the displacement that it took away. Of lines the renaming of teeth adds the
  // same to `residual`, so that it is not checked, and -p . d / 2 of a start that violates the contact conditions is here; p . d of the steps
  // themselves is imbalance.
  double dropped = 0;
  // With friction, else 0. (mesh) friction: all that it takes, integral of mu s N v of the kinematics with the vibration in v.
  // friction_rolling: work of the prescribed rolling against it, from torques and angular momenta: each gear turns by w_b against
  //   T_b + D_b - N_b - dL_b/dt,
  // N_b the moment of the normal forces, L_b = I_b theta_b' of the rigid rotations, less what the dampers of the axes take. D_b holds the
  // mean speed of a train that can roll, along I_b times its rolling, and follows from one gear for each rolling, of a pair from the driver: of
  // that gear, and of bodies that are held, the moment of friction itself stands there. No sliding speed is in it.
  Eigen::VectorXd friction;
  double friction_rolling = 0;
  double throughput = 0;  // sum of |drive| + |rolling| + |friction_rolling| per step
  double imbalance = 0;   // largest |sum of the lines since the start of a period|

  // Of so many meshes and bodies; all 0 unless it is of as many already.
  void begin(Eigen::Index meshes, Eigen::Index bodies);
  double storage() const { return kinetic + modal + residual + local; }
  double left_over() const;          // what the lines leave open
  Eigen::RowVectorXd lines() const;  // (line of kEnergyLines)
};

}  // namespace whine
