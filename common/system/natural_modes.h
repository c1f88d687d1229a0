// Natural modes of a system of rigid bodies with its meshes frozen at their mean stiffness: K v = w^2 M v.
//
// A planetary train of N equal planets at equal spacing is cyclically symmetric: turned by 2 pi / N it is itself. The turn R, which
// hands each planet's motion to the next one and turns x and y, commutes with K and M, so that the space of motions splits into
// those of harmonics k = 0 .. N/2, the images of
//   P_k = (c / N) sum_j cos(2 pi j k / N) R^j,   c = 1 for k = 0 and N/2, else 2,
// and the eigenproblem is solved in each. k = 0 are the rotational modes, k = 1 the translational ones (double), others planet
// modes, in which the central members are at rest (Lin and Parker 1999). So types and degenerate pairs do not hang on round-off.
#pragma once
#include "results/modes.h"
#include "results/static.h"
#include "system/rigid_system.h"

namespace whine {

// Modes with w^2 below this share of the largest w^2 are free motions: their frequency is reported as 0.
inline constexpr double kFreeMotion = 1e-11;

// All modes. Without the symmetry modes are typed by the share of kinetic energy of the central members in translation and in
// rotation, either nothing (below 1e-8: round-off) or not. Of a pair of equal frequencies the first is turned so that the
// coordinate that moves most in the pair is at rest in the second; signs make that coordinate positive. Throws as rigid_system, and
// Error(numerical) if the eigenproblem is not solved. mesh_stiffness: see rigid_system.
ModesResult natural_modes(const System& layout, const Eigen::MatrixXd& mesh_stiffness = {});
// (mode) Hz, ascending: their natural frequencies without those of free motions.
Eigen::VectorXd rigid_frequencies(const System& layout, const Eigen::MatrixXd& mesh_stiffness);

// Of elastic gears that do not vibrate themselves: M of the gears as rigid bodies, and the frozen stiffness of contact and
// bodies that their statics have, averaged over the mesh period (modes) and at each phase (frozen_frequency). Planets whose meshes
// differ, in their mean by tenths of a per cent where phases differ, have the types of planets with equal meshes. Throws as above.
ModesResult elastic_modes(const SystemStaticResult& at_rest);

}  // namespace whine
