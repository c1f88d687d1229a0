// What the third dimension of a gear body adds to its plane flexibility.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/matrix.h"

namespace whine {

// Largest degree of the polynomials over the face: beyond it the tables are not finer but the line contact of a slice ends to hold.
inline constexpr int kLargestDegree = 24;

// Flexibility of the driving flank between Legendre polynomials over the face width, at the points of a flank table. Load on tooth 0:
// normal force per face width q(z) = sum_j P_j(z) q_j at roll angle xi'; reading: inward normal displacement u(z) = sum_i P_i(z) u_i at
// roll angle xi, in axes that turn with the helix (contact lines: roll angle xi_0 + helix z). P_j: base/legendre.h, z from the middle of
// the gear's face. u_i = C_ij(xi, xi') q_j.
struct WidthTables {
  int degree = 0;         // P: polynomials 0 .. P
  double face_width = 0;  // m
  double helix = 0;       // rad m-1: kappa = tan(beta_b) / r_b, turn of the section with z, > 0: right-hand
  Eigen::VectorXd flank_position;  // (flank) rad: roll angle of the table points, ascending
  // [offset] (flank degree + 1, flank degree + 1) m2 N-1: C of the tooth `offset` counter-clockwise of the loaded one; rows: reading, of
  // each point the polynomials 0 .. P. Offset 0: dC_ij = C_ij - delta_ij share C2, C2 the plane strain flexibility of the transverse
  // section on the same mesh, so that dC is smooth and holds no near field.
  std::vector<MatrixRM> flexibility;
  // [offset + largest] (root degree + 1, flank degree + 1) Pa m N-1: stress across the helix at the driving root's points (root_position of the
  // body), sigma(z) = sum_i P_i(z) sigma_i, of the tooth `offset` counter-clockwise of the loaded one.
  std::vector<MatrixRM> root_stress;
};

}  // namespace whine
