// From the drawing of a train to its bodies and meshes: places, senses of rotation, phases, and whether it can be assembled.
//
// A carrier puts a planet at each position psi_n about the axis of the central gear that the planets mesh with. Sun and ring
// meshes are ahead of each other by what tooth numbers and angles say (gear/train.h). N planets between a sun of z_s teeth and a
// ring of z_r can be put in where (z_s + z_r) psi_n / (2 pi) is whole for all n, at equal spacing where (z_s + z_r) / N is.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "gear/train.h"
#include "model/scene.h"

namespace whine {

// Positions of a carrier that lie within this share of a step 2 pi / (z_s + z_r) from one that can be assembled are taken for it:
// a drawing has 91.43 degrees, not 91.428571...
inline constexpr double kPositionDigits = 0.05;

// What to do where two gears share a shaft.
inline constexpr const char* kOneShaft =
    "gears that share a shaft are not computed, only gears in mesh; compute each stage by a scene of its own";

// SectionError at the first of the meshes (names of their gears) that no others join to the first mesh.
void require_joined(const std::vector<std::array<std::string, 2>>& meshes);

// Bodies are in the order in which meshes name them, planets as <gear>1, <gear>2, ... in the order of their positions, carriers
// last. Throws SectionError with the section that is wrong: unknown names, gears that do not mesh, planets that cannot be
// assembled, gears without a mesh that run into each other, meshes that do not form one train.
System layout_of(const Scene& scene);

// [body] the [gear.<name>] that a body of the layout is, "" of a carrier; [mesh] the [[mesh]] that a mesh of it comes from.
std::vector<std::string> gears_of(const Scene& scene, const System& layout);
std::vector<int> sections_of(const std::vector<GearMeshSpec>& meshes, const std::vector<std::string>& gears,
                             const System& layout);

// Whether a body is an internal gear: in its meshes both sides turn in one sense, and it has more teeth.
bool is_ring(const System& system, int body);

// The gear that meshes with planets of a carrier and is held: it does not turn in a machine in which the carrier turns; -1: none.
int held_by_planets(const System& system, int carrier);

// How the members of a train turn in a machine, beside the frame of the layout, in which no axis moves. Where a carrier is free,
// the gear that meshes with its planets is at rest and the frame turns; else the frame is at rest.
struct TrainSpeeds {
  std::vector<double>
      turns;  // (body) 1: revolutions in a mesh period, counter-clockwise positive; of a planet on its pin
  std::string at_rest;  // the gear or carrier at rest; "": none is named, as of gears on the ground
};
// Throws Error(input) where it does not follow from what is held: a free carrier whose planets mesh with no held gear, or carriers that
// would have to turn at two speeds.
TrainSpeeds train_speeds(const System& system);

// 1: revolutions of the frame of the layout in a mesh period, counter-clockwise positive: of the one carrier of a train on one axis,
// which is free, and one gear that meshes with its planets is held. 0 of other trains, also where the speed does not follow from
// what is held, or axes on the ground would go round with the frame.
double frame_turns(const System& system);
// 1: revolutions of a body on the ground in a mesh period, in its own sense, where the frame turns so.
double ground_turns(const System& system, int b);
// The body of the first drive that gives power, else the first body that turns. Throws Error(input) where nothing turns, and as
// train_speeds().
int input_of(const System& system);
// The free body on the ground where most power leaves the train by its drive: with friction what it gives follows from the losses.
// -1: none.
int output_of(const System& system);

// m: working pitch radius in the first mesh of a gear; of a carrier, and of a gear without a mesh, System::Body::radius.
double working_radius(const System& system, int body);

}  // namespace whine
