// Rigid gears and carriers on springs: mass and stiffness matrix of a system, one spring for each mesh.
//
// Each body has the freedoms u = r theta (m; r of System::Body, theta in the body's own sense) and, on an elastic bearing, the
// displacements x, y of its axis (m). With U_b and X_b the rows that pick these from all freedoms q:
//   closing of a mesh   delta = (U_1 + n X_1) - (U_2 + n X_2),   n the line of action from the first side's flank to the second's
//   bearing             X_b - X_c(P),   X_c(P) = X_c + theta_c x (P - C): displacement of a carrier at the axis P; 0 of the ground
//   M = sum m X_b^T X_b + (I / r^2) U_b^T U_b,   K = R^T K_mesh R + sum k row^T row over bearings and drives that hold,
// R the closing rows, K_mesh diagonal but where elastic bodies join meshes.
// The closing row is the one by which the strips of elastic gears move (ContactMap). Where a body has no elastic bearing, X_b is
// that of what carries it. Frame: that of the carrier, at rest; Coriolis and centrifugal terms are left out, of relative size
// 2 Omega_c / w.
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
  Eigen::MatrixXd closing;          // (mesh, freedom) 1: rows of the springs of the meshes
  Eigen::MatrixXd mesh_stiffness;   // (mesh, mesh) N m-1
  Eigen::MatrixXd mass, stiffness;  // (freedom, freedom) kg, N m-1

  Eigen::Index freedoms() const { return mass.rows(); }
};

// Throws Error(input) that names the body or mesh for a radius, inertia, mass or stiffness that is not positive, for a body without
// a place, and if all freedoms are held.
//
// mesh_stiffness: (mesh, mesh) N m-1, of meshes that elastic bodies join (SystemStatics::mesh_stiffness()), symmetric; empty:
// those of the layout, each by itself. On its diagonal a mesh without load may have 0.
RigidSystem rigid_system(const System& layout, const Eigen::MatrixXd& mesh_stiffness = {});

}  // namespace whine
