// Rigid gears and carriers on springs: mass and stiffness matrix of a system, one spring for each mesh.
//
// Each body has the freedoms u = r theta (m; r of System::Body, theta in the body's own sense) and, on an elastic bearing, the
// displacements x, y of its axis (m). With U_b and X_b the rows that pick these from all freedoms q:
//   closing of a mesh   delta = (U_1 + n X_1) - (U_2 + n X_2),   n the line of action from the first side's flank to the second's
//   bearing             X_b - X_c(P),   X_c(P) = X_c + theta_c x (P - C): displacement of a carrier at the axis P; 0 of the ground
//   M = sum m X_b^T X_b + (I / r^2) U_b^T U_b,   K = R^T K_mesh R + sum k row^T row over bearings and drives that hold,
// R the closing rows, K_mesh diagonal but where elastic bodies join meshes.
// The closing row is the one by which the strips of elastic gears move (ContactMap). Where a body has no elastic bearing, X_b is
// that of what carries it. Frame: that of the carrier. Where it turns at Omega (rad s-1, counter-clockwise), with J = [[0, -1], [1, 0]],
//   M q" + 2 Omega G q' + (K - Omega^2 N) q = 0,   G = sum m X_b^T J X_b,
//   N = sum m X_b^T X_b,   of a planet at P:   m (Y^T Y + X_c^T d U_c + U_c^T d^T X_c),   Y = X_b - d U_c,   d = e_z x (P - C) / r,
// by |X_c + R(theta) (P - C + y)|^2: a planet that goes round with its carrier comes no farther out. Springs to the ground are alike in all
// directions, so that they are the same in the frame.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "gear/layout.h"

namespace whine {

struct RigidSystem {
  System layout;
  struct Spring {
    enum class Kind { mesh, bearing, hold } kind;
    int number = 0;        // of the mesh, or of the body
    Eigen::MatrixXd row;   // (1, or xy; freedom) 1
    double stiffness = 0;  // N m-1
  };
  std::vector<Eigen::MatrixXd> rotation, translation;  // [body] U (1, freedom), X (xy, freedom)
  std::vector<Spring> springs;
  Eigen::MatrixXd closing;                  // (mesh, freedom) 1: rows of the springs of the meshes
  Eigen::MatrixXd mesh_stiffness;           // (mesh, mesh) N m-1
  Eigen::MatrixXd mass, stiffness;          // (freedom, freedom) kg, N m-1
  Eigen::MatrixXd gyroscopic, centrifugal;  // (freedom, freedom) kg: G, N

  Eigen::Index freedoms() const { return mass.rows(); }
};

// Throws Error(input) that names the body or mesh for a radius, inertia, mass or stiffness that is not positive, for a body without
// a place, and if all freedoms are held.
//
// mesh_stiffness: (mesh, mesh) N m-1, of meshes that elastic bodies join (SystemStatics::mesh_stiffness()), symmetric; empty:
// those of the layout, each by itself. On its diagonal a mesh without load may have 0.
RigidSystem rigid_system(const System& layout, const Eigen::MatrixXd& mesh_stiffness = {});

}  // namespace whine
