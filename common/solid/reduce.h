// From a sector mesh to the body that contact needs: modes with the hub fixed and the flexibility between
// flank points.
//
// P2000 splits the displacements by the eigenvectors of K (Eq. 10), which makes K diagonal (Eq. 11): elastic coordinates q_phi = K^-1 g
// (Eq. 12) and rigid ones. Here the elastic ones are the modes with the hub fixed and the rigid one is the rotation of the hub. The
// flexibility is q_phi under contact forces (Eq. 15), read on the flank.
//
// Flexibility by singularity subtraction: in the tooth region D the displacement under a unit normal force at
// s_j is u = u_hs + w, u_hs the line-load field of the tangent half-plane at s_j. The unknowns are w inside D
// and on its free sides, u on the cut between D and the rest and beyond it; with t_hs the traction of u_hs on
// the sides of D,
//   K x = -(sum over sides of D of N^T t_hs) + K_D W,   W = u_hs at the nodes of the cut, 0 elsewhere.
// w is smooth, so the elements need not resolve the contact; the logarithm stays analytical. Every harmonic
// of the cyclic gear has the same load; offsets between teeth follow by the inverse discrete Fourier
// transform.
//
// Or by matching at a depth d, as Parker, Vijayakar and Imajo (J. Sound Vib. 237 (2000) 435) do: the finite
// elements carry the force itself, as consistent nodal forces on the flank, and are read at the point d below
// s_i; the half-plane gives what lies between that point and the surface. Load and reading are at different
// places, so the table is not symmetric, and both the spread of the nodal load, (element / d)^2, and the finite
// body, d / tooth, leave their errors in it.
#pragma once
#include "results/reduced_body.h"
#include "solid/flank_loads.h"

namespace whine {

constexpr int kOffsets = 3;

// Both flanks: the reading of the other flank under a force on the driving flank, X_d on the tooth d counter-clockwise of the
// loaded one, needs no solution of its own. A tooth is its own mirror image, so a force on the other flank moves the driving
// flank of tooth -d by X_d, and by reciprocity X_d = X_d^T.
//
// modes: elastic modes of the whole gear to keep, 0 or more, or kAllModes; the torsional zero-diameter mode is always among them, and
// the first three of zero diameters up to twice the highest frequency of the others. Near field and points of the flank are those of mesh.discretisation. Throws Error(input) for a matching depth whose points are
// not all inside the tooth and for kAllModes of a mesh that is too fine for dense algebra, Error(numerical) if a
// factorisation, an eigensolution or a table does not pass its check.
ReducedBody reduce(const SectorGrid& mesh, const Material& material, int modes);

// Adds the third dimension to a body in plane strain: the tables over its face width. All else of the body stays. Throws as
// make_width_tables(), Error(input) for a body in plane stress.
void add_width(const WidthDiscretisation& width, ReducedBody& body);

// Reads the root stress of a body anew, from `mesh` with elements on the root that are `share` (0 to 1, neither) times as large as those
// that reduce() reads it from. All else of the body stays. Returns their size (m). Throws as reduce(), Error(input) for another share.
double refine_root_stress(const SectorGrid& mesh, double share, ReducedBody& body);

}  // namespace whine
