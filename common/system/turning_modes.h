// Natural frequencies of a system of rigid bodies whose frame turns with its carrier, M q" + 2 Omega G q' + (K - Omega^2 N) q = 0
// (system/rigid_system.h): the imaginary parts of its eigenvalues. Those of -Omega are the same ones, of motions mirrored.
// The sum of their squares is trace(M^-1 (K - Omega^2 N)) - 2 Omega^2 trace((M^-1 G)^2).
#pragma once
#include <Eigen/Core>

#include "results/modes.h"
#include "system/rigid_system.h"

namespace whine {

// (freedom) Hz, ascending, free motions by 0; omega: rad s-1. Throws Error(input) with the speed if a motion grows there: the frame is
// above a critical speed.
Eigen::VectorXd turning_frequencies(const RigidSystem& system, double omega);

// Of modes at their mean stiffness, the frequencies up to the mesh frequency at which the first harmonic meets the highest one, or up to
// that at which a motion grows; nothing where the frame is at rest, see frame_turns(). mesh_stiffness: as of natural_modes().
void add_turning_frequencies(ModesResult& modes, const Eigen::MatrixXd& mesh_stiffness);

}  // namespace whine
