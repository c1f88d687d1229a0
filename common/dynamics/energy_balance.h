// Where the energy of an integrated mesh period goes.
#pragma once

namespace whine {

// J, summed over the steps of a period. Every line is computed by itself, none as what is left of the others. With mean
// forces p' = (p_n + p_n+1)/2:
//   d(storage) + modal_damping + relaxation_damping + friction
//     = torque + rolling + friction_rolling + switching + cutting + dropped - averaging.
struct EnergyBalance {
  double kinetic = 0, modal = 0;  // change of: energy of motion; of the kept modes' springs
  // Change of: residual flexibility; half-planes, lines' laws and all else that is instantaneous.
  double residual = 0, local = 0;
  double torque = 0;   // work of the constant torques on the vibration
  double rolling = 0;  // of the prescribed rolling: gaps, participation and compliance change with phase
  double modal_damping = 0;  // Rayleigh and bearing dampers of the kept coordinates, by quadrature of v^2
  double relaxation_damping = 0;  // of the residual flexibility, by quadrature
  // The scheme's own: strips or lines that open or close within a step, (p_n d_n+1 - p_n+1 d_n) / 2, and what the
  // trapezoid of force over indentation misses of the energy of a line's bent law.
  double switching = 0;
  double cutting = 0;    // pairs that a corner rule takes out, or lets in, while they carry force
  double averaging = 0;  // the scheme's own: mean load times change of the relaxed load, less the exact work
  // The relaxed load of a tooth that is no longer followed, about a mesh period after its load: minus the energy G R G / 2
  // that goes with it, plus the work of the mean contact forces on the displacement that it took away.
  double dropped = 0;
  // Of a pair with friction, else 0. friction: all that it takes, integral of mu s N v of the kinematics with the vibration in
  // v. friction_rolling: work of the prescribed rolling against friction, from the torques: T_1 w_1 - T_2 w_2, plus the work of
  // what holds the mean speed, less that of normal forces off the line of action. What holds the speed is the moment by which
  // the change of the driver's angular momentum differs from torque and contact moments; it acts on both gears in proportion
  // to inertia times speed. Sliding speeds are in the first line alone, the moment on the driven gear in the second alone.
  double friction_rolling = 0, friction = 0;
  double throughput = 0;  // sum of |torque| + |rolling|, of both rollings with friction, per step
  double imbalance = 0;   // largest |sum of the imbalance so far|

  double storage() const { return kinetic + modal + residual + local; }
};

}  // namespace whine
