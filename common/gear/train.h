// Positions and rotations of the gears of a system: senses of rotation, places, phases of the meshes.
//
// A gear of z teeth and sense s (1: counter-clockwise) has its tooth 0 at the angle A + s f 2 pi / z, f the phase of the
// system in mesh periods. A flank at the angle phi from tooth 0 passes the pitch point of a mesh in the direction
// beta in each mesh period, first at
//   f = -s (A + phi - beta) z / (2 pi)   modulo 1,
// so that the mesh is ahead of the system by the negative of that. Its first side turns towards the second one's flank: both
// work with their leading flanks where the first side turns counter-clockwise, else with their trailing ones. A ring and its
// pinion turn in the same sense: the second side then works with the other kind of flank than the first.
#pragma once
#include <string>

#include "gear/pair.h"
#include "model/stages.h"
#include "model/system.h"

namespace whine {

// The first gear of a system: counter-clockwise, centre at the origin; its first mesh has the phase 0. Returns 0, its number.
int add_input_gear(System& system, const std::string& name, const GearDesign& gear,
                   const Bearing& bearing = {});

// A gear that body `on` drives, its axis `centre_distance` (m) away; `direction` (rad, counter-clockwise from +x): from the
// centre of `on` to the pitch point, in which the driven gear's centre lies, too, but for that of a ring around `on`, which lies
// in the opposite one. Adds the body and the mesh; returns the number of the body. Throws what GearPair throws.
int add_driven_gear(System& system, int on, const GearDesign& driver, const std::string& name,
                    const GearDesign& gear, double centre_distance, double direction,
                    const Bearing& bearing = {});

// A mesh in which body `on` drives body `to`, both of which have places already. Returns by how many pitches, -1/2 to 1/2, the teeth of `to`
// miss the tooth spaces; 0 to round-off if the train can be assembled. Throws Error(input) if `to` would have to turn in
// both senses, and what GearPair throws.
double add_mesh(System& system, int on, const GearDesign& driver, int to, const GearDesign& gear);

// The pair of a result, with its inertias.
System pair_system(const MotionParameters& pair);

// The pair of a scene: the driver at the origin, the driven gear, which is held, above it. No torque.
System pair_system(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven);

}  // namespace whine
