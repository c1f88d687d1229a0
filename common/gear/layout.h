// What follows from the layout of a train alone: names, lines of action, what carries a body.
#pragma once
#include <string>

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

// m: position error of the axis of a body.
inline Vec2 offset_of(const System::Body& body) {
  return {body.offset[0], body.offset[1]};
}

// A mesh of a planet moves with its carrier: by how much a unit u of the carrier closes it along the line of action.
struct CarriedMesh {
  int carrier = -1;  // number of the body; -1: no side of the mesh is on a carrier
  int side = 0;      // of the planet
  double closing = 0;
};
CarriedMesh carried_mesh(const System& system, size_t m);

// Whether the axis of a body is on the ground, or on a carrier whose axis is on the ground. A carrier on a carrier, or on
// itself, is not in the model.
bool has_place(const System& layout, const System::Body& body);

// Whether a body is a carrier that may turn or move: its planets do so with it.
bool moving_carrier(const System& layout, int b);
// Whether a body is a planet on a rigid pin of such a carrier: the force on its pin has the inertia of the planet.
bool on_rigid_moving_pin(const System& layout, int b);

}  // namespace whine
