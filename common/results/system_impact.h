// Natural frequencies and damping of a system of elastic gears by ring-down, at fixed mesh phases.
#pragma once
#include <Eigen/Core>

#include "base/matrix.h"
#include "model/system_stages.h"

namespace whine {

// impact.h5 of a system. Modes by rising undamped frequency at each phase: two that are near may change places between phases.
struct SystemImpactResult {
  SystemSweepParameters
      settings;               // with the inertias and masses that were used; speeds and time steps are not
  Eigen::VectorXd torque;     // (body) N m of its drive; 0 where none gives a torque
  double axis_frequency = 0;  // Hz, see axis_frequency()
  double impulse = 0;         // 1: see SystemImpactPlan
  Eigen::VectorXd rigid_frequency;  // (rigid_mode) Hz: of rigid gears on the mean stiffnesses of the meshes
  Eigen::VectorXd mesh_phase;       // (phase) 1
  MatrixRM loaded_pairs;            // (phase, mesh) 1: pairs of teeth that carry force
  MatrixRM undamped_frequency;      // (phase, mode) Hz: contact frozen
  // (phase, mode) 1: (mu + eta w^2) / (2 w) at the undamped frequency, as if all that deforms were damped by Eq. 21 and nothing else
  MatrixRM rayleigh_damping_ratio;
  // (phase, mode) Hz, 1: eigenvalues of the frozen contact; 0 and 1 where the mode is damped above critical
  MatrixRM eigen_frequency, eigen_damping_ratio;
  // (phase, mode) Hz, 1: of the decays; 0 and 1 likewise
  MatrixRM natural_frequency, damping_ratio;
  MatrixRM
      fit_residual;  // (phase, mode) 1: RMS of what no damped exponentials explain over that of the decay
  MatrixRM
      contact_changes;  // (phase, mode) 1: steps of the decay at which other pairs carry force than before
};

}  // namespace whine
