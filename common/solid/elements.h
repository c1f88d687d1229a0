// Plane isoparametric elements: 4 nodes (bilinear) and 9 nodes (biquadratic), fully integrated (2x2 and 3x3
// Gauss points). Displacements are ordered node by node: x0, y0, x1, y1, ...
//
// Node order: corners counter-clockwise from (-1, -1), then the mid-sides of the sides 0-1, 1-2, 2-3, 3-0,
// then the centre. Bathe, Finite Element Procedures, section 5.3.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/matrix.h"
#include "contact/plane_moduli.h"
#include "model/gear.h"

namespace whine {

using SparseReal = Eigen::SparseMatrix<double>;

// Lagrange polynomials of a side and their slopes at a in [-1, 1]; order start, end, middle. nodes: 2 or 3.
struct SideShape {
  double value[3], slope[3];  // 1
};
SideShape side_shape(std::size_t nodes, double a);

// Shape functions at a point of the reference square and their derivatives there.
struct Shape {
  Eigen::VectorXd value;                           // (node) 1
  Eigen::Matrix<double, Eigen::Dynamic, 2> slope;  // (node, 2) 1: with respect to the reference coordinates
};
Shape shape_functions(int nodes, double a, double b);  // nodes: 4 or 9; throws Error(input) otherwise

// The point of the reference square that the element maps to p: (a, b), within [-1, 1] if p lies in the element. nodes:
// (4 or 9, 2) m; p: m. False if Newton's method finds none, as it may for a p far outside.
bool invert_map(const Eigen::MatrixX2d& nodes, const Eigen::Vector2d& p, Eigen::Vector2d& reference);

// Gauss-Legendre points and weights on [-1, 1]; exact for polynomials of degree 2 n - 1.
struct GaussRule {
  Eigen::VectorXd point, weight;  // (point) 1
};
GaussRule gauss_rule(int points);

// Place of node k of the element in the reference square: -1, 0 or 1 along each side.
Eigen::Vector2d reference_node(int k);

// Strain (xx, yy, engineering xy) 1 at a point of the reference square; nodes and their displacements: (4 or 9, 2) m.
Eigen::Vector3d element_strain(const Eigen::MatrixX2d& nodes, const Eigen::MatrixX2d& displacement, double a,
                               double b);

// K and M of Eq. 1, of one element. nodes: (4 or 9, 2) m. Results (2 node, 2 node) N m-1 and kg. Throw Error(numerical) where the
// Jacobian is not positive.
Eigen::MatrixXd element_stiffness(const Eigen::MatrixX2d& nodes, const Material& material, double thickness);
Eigen::MatrixXd element_mass(const Eigen::MatrixX2d& nodes, double density, double thickness);

// Stiffness of a prism whose section turns with z by helix z about the origin, counter-clockwise: displacements are sums over j of N_n(x, y)
// f_j(z) U_ncj, x, y and the components in axes that turn with the section. With D_t N = helix (y N,x - x N,y) the strain (xx, yy, zz, xy,
// yz, zx) is sum_j (f_j B0 + f_j' Bz) U_j, so that
//   K_ij = int f_i f_j K00 + int f_i f_j' K01 + int f_i' f_j K01^T + int f_i' f_j' K11,   K00 = int B0^T C B0 dA,   K01, K11 with Bz.
struct SectionStiffness {
  Eigen::MatrixXd k00, k01, k11;  // (3 node, 3 node), unknowns x y z of each node: Pa, Pa m, Pa m2
};
// nodes: (4 or 9, 2) m; helix: rad m-1. The plane state of the material has no meaning to it. Throws Error(numerical) where the Jacobian is
// not positive.
SectionStiffness section_stiffness(const Eigen::MatrixX2d& nodes, const Material& material, double helix);

// The same of all elements, one pattern for all three and K01^T. number: (node) 0 .. count - 1, its place among the unknowns, or -1: held.
struct SectionSystem {
  SparseReal k00, k01, k10, k11;  // (3 count, 3 count); k10: K01^T
};
SectionSystem assemble_section(const MatrixRM& node_position, const MatrixRMi& element_node,
                               const Material& material, double helix, const Eigen::VectorXi& number,
                               int count);

// Readings of displacements sum_j P_j(z) U_j of a prism, their polynomials over the face width those of base/legendre.h: coefficient i of
// a reading is sum over j of (delta_ij value + slope int P_i P_j' dz)^T U_j. The transpose of one without slopes is a force.
struct FaceFunctional {
  SparseReal value, slope;  // (3 node, functional), unknowns x y z of each node; no columns: no slopes
};

// Least Jacobian determinant over corners and Gauss points of all elements, over the element's mean. 1; > 0
// is needed.
double least_jacobian(const MatrixRM& node_position, const MatrixRMi& element_node);

// m2: sum of the elements' areas.
double mesh_area(const MatrixRM& node_position, const MatrixRMi& element_node);

struct PlaneSystem {
  SparseReal stiffness;  // (2 node, 2 node) N m-1
  SparseReal mass;       // (2 node, 2 node) kg
};

// Sums the elements for which keep[element] holds; an empty `keep` takes all of them.
PlaneSystem assemble(const MatrixRM& node_position, const MatrixRMi& element_node, const Material& material,
                     double thickness, const std::vector<char>& keep = {});

// (2 node) m per rad: the displacement of a small counter-clockwise rotation about the origin.
Eigen::VectorXd rotation_field(const MatrixRM& node_position);

}  // namespace whine
