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
#include <array>
#include <string>
#include <vector>

#include "gear/involute.h"
#include "model/system.h"

namespace whine {

// By which sign a motion of side 0 or 1 along the line of action closes a mesh.
inline double closing_sign(int side) {
  return side == 0 ? 1 : -1;
}

// Unit vector along the line of action of a mesh, from the first side's flank to the second's, in the frame of the system.
Vec2 line_of_action(const System::Mesh& mesh);

// Displacement of the axis P of a planet per unit u = r theta of its carrier, theta x (P - C) / r: a tangent of the circle of the pins.
Vec2 pin_direction(const System& system, const System::Body& planet);

// A mesh of a planet moves with its carrier: by how much a unit u of the carrier closes it along the line of action.
struct CarriedMesh {
  int carrier = -1;  // number of the body; -1: no side of the mesh is on a carrier
  int side = 0;      // of the planet
  double closing = 0;
};
CarriedMesh carried_mesh(const System& system, size_t m);

// "sun-planet1": a mesh by its bodies.
std::string mesh_name(const System& system, size_t m);

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

// Whether the axis of a body is on the ground, or on a carrier whose axis is on the ground. A carrier on a carrier, or on
// itself, is not in the model.
bool has_place(const System& layout, const System::Body& body);

}  // namespace whine
