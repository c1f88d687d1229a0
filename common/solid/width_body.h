// The flexibility of a gear's teeth over the face width: sections times Legendre polynomials over the width, in axes that turn with the
// helix.
//
// Displacements are sums over polynomials j = 0 .. P of N_n(x, y) P_j(z) U_ncj (elements.h has the strain). Nothing depends on z, so the
// body is a prism, and its sector obeys the same cyclic symmetry as the plane one, u_z unturned by Q. The stiffness of the sector is real
// and the same for all harmonics; they differ in how the two edges are tied. So the sector is condensed once, edges kept, to S, R
// and D (factor.h), and a harmonic of the phase theta is a dense system of one edge,
//   S_n = S_ll + Q^T S_hh Q + exp(i theta) S_lh Q + its adjoint,   R_n = R_l + exp(-i theta) Q^T R_h,   G_n = D + R_n^H S_n^-1 R_n.
// The tooth is its own image under half a turn about its centre line (x, y, z -> -x, y, -z), which maps harmonic n to -n: with the edge
// turned half a pitch to the centre line and the components that change their sign times i, S_n is real. A spur gear falls apart
// into {u_x, u_y even in z, u_z odd} and the rest.
#pragma once
#include "results/sector_grid.h"
#include "results/width_tables.h"
#include "solid/elements.h"
#include "solid/width_tables.h"

namespace whine {

// (3 node, point) 1: of the points xi of the driving flank (rad), -n_c N_n(xi), the nodal forces of a unit force along the inward normal
// n = (n_t, -helix r_b) / sqrt(1 + (helix r_b)^2) in turned axes, n_t outward in the section. Its transpose reads the inward displacement.
SparseReal inward_normal(const SectorGrid& section, double helix, const Eigen::VectorXd& flank_position);

// C between functionals times polynomials: [offset] (functional degree + 1, functional degree + 1) m2 N-1, the reading of functional i
// times P_k on the tooth `offset` counter-clockwise of that on which functional j times P_l is the force, per unit of it (N m-1).
// functional: of a spur gear values without z and slopes of z alone, others are not looked at. section: the gear's own mesh for this.
// helix: rad m-1, kappa = tan(beta_b) / r_b, > 0 for a right-hand gear; the plane state of the material has no meaning here. Throws Error(input) for a degree outside 0 .. kLargestDegree and for a ring on an elastic support, Error(numerical) if a
// factorisation fails.
std::vector<MatrixRM> width_flexibility(const SectorGrid& section, const Material& material, double helix,
                                        int degree, const FaceFunctional& functional, int offsets);

// Tables for the points flank_position (rad, ascending, on the flank) and the tooth offsets 0 .. offsets; errors as width_flexibility().
// The section mesh may be much coarser than that of the plane tables: dC is smooth.
WidthTables make_width_tables(const SectorGrid& section, const Material& material, double helix, int degree,
                              const Eigen::VectorXd& flank_position, int offsets);

}  // namespace whine
