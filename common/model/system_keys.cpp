#include "model/key_units.h"
#include "model/keys.h"

namespace whine {

using namespace units;

// clang-format off
KeyList equivalent_mass_key(double& equivalent_mass) {
  KeyList k("rigid_gear");
  k.add(&equivalent_mass, "equivalent_mass_kg", kKilogram, "0.0", {0, 1e9}, "of a system with body = \"rigid\": inertia over the square of the base radius, in place of total_inertia_kgm2; 0: not given");
  return k;
}

KeyList keys(Scene::Mesh& m) {
  KeyList k("train_mesh");
  k.add(&m.direction, "direction_deg", kDegree, "90", {-360, 360}, "of a system: from the driver's axis to the pitch point, counter-clockwise from +x; without meaning where a planet takes part, whose positions say it");
  k.add(&m.stiffness, "stiffness_N_um", kNewtonPerMicrometre, "0.0", {0, 1e6}, "of a system with body = \"rigid\", which needs it: mean stiffness along the line of action");
  return k;
}

KeyList keys(Scene::Carrier& c) {
  KeyList k("carrier");
  k.add(&c.name, "name", kNone, nullptr, {}, "name of the carrier, for [[bearing]] and [[drive]]");
  k.add(&c.planet, "planet", kNone, nullptr, {}, "name of the gear that it carries at each position; a [[mesh]] or [[bearing]] of this gear is one of each planet, its bearing a pin of the carrier");
  k.add(&c.planets, "planets", kNone, "0", {0, 100}, "number of planets at equal spacing; it must divide the sum of the teeth of sun and ring");
  k.add(&c.positions, "positions_deg", kDegree, "", {-360, 360}, "in place of planets: a list of angles, counter-clockwise from +x, that are apart by multiples of 360 over the teeth of sun and ring, to a twentieth of that step").each = "planet";
  k.add(&c.inertia, "inertia_kgm2", kInertia, "0.0", {0, 1e9}, "inertia of the carrier about its axis; with planets on rigid pins their masses included");
  k.add(&c.equivalent_mass, "equivalent_mass_kg", kKilogram, "0.0", {0, 1e9}, "inertia over the square of the radius of the pins, in place of inertia_kgm2, of the same masses; 0: not given");
  return k;
}

KeyList keys(Scene::Pin& p) {
  KeyList k("pin");
  k.add(&p.planet, "planet", kNone, nullptr, {}, "name of the planet: that of the carrier's gear and its number, in the order of the positions from 1, as planet2");
  k.add(&p.radial, "radial_um", kMicrometre, "0.0", {-1000, 1000}, "position error of its pin, away from the carrier's axis");
  k.add(&p.tangential, "tangential_um", kMicrometre, "0.0", {-1000, 1000}, "position error of its pin, counter-clockwise about the carrier's axis");
  return k;
}

KeyList keys(Scene::Drive& d) {
  KeyList k("drive");
  k.add(&d.gear, "gear", kNone, nullptr, {}, "name of the gear or carrier that it acts on; one without a drive is free of torque");
  k.choice(d.kind, "kind", nullptr, "a torque, a rotation that is held, or nothing");
  k.add(&d.torque, "torque_Nm", kNewtonMetre, "0.0", {-1e7, 1e7}, "of kind torque, positive in the sense in which the body turns");
  k.add(&d.stiffness, "stiffness_N_um", kNewtonPerMicrometre, "0.0", {0, 1e6}, "of kind held: stiffness of what holds the rotation, at the base radius, of a carrier at that of its pins; 0: rigid");
  return k;
}

// --- of a layout: in SI, in stage parameters as [[body]], [[mesh]], [[drive]] and in artifacts a column each

namespace {

constexpr Limits kSwitch{0, 1}, kTurn{-1e6, 1e6}, kPlace{-1000, 1000}, kNumber{0, 10000}, kStiff{0, 1e15}, kMass{0, 1e9};
constexpr Unit kRadian{"", "rad"}, kMetre{"", "m"}, kPerMetre{"", "N m-1"};

}  // namespace

KeyList keys(System::Body& b) {
  KeyList k("body");
  k.add(&b.name, "name", kNone, nullptr, {}, "name of the body");
  k.add(choice_slot(b.kind), "is_carrier", kNone, nullptr, kSwitch, "1: a carrier, 0: a gear");
  k.add(&b.teeth, "teeth", kNone, nullptr, {0, 2000}, "number of teeth, 0 of a carrier");
  k.add(&b.sense, "sense", kNone, nullptr, {-1, 1}, "sense of rotation: 1 counter-clockwise, -1 clockwise");
  k.add(&b.angle, "angle", kRadian, nullptr, kTurn, "angle of tooth 0 from +y at mesh phase 0, counter-clockwise");
  k.add(&b.centre[0], "x", kMetre, nullptr, kPlace, "place of the axis");
  k.add(&b.centre[1], "y", kMetre, nullptr, kPlace, "place of the axis");
  k.add(&b.radius, "radius", kMetre, nullptr, {1e-6, 10}, "base radius; of a carrier that of the pins");
  k.add(&b.inertia, "inertia", Unit{"", "kg m2"}, nullptr, kMass, "inertia about the axis");
  k.add(&b.on, "stands_on", kNone, nullptr, {System::kGround, 10000}, "number of the carrier that carries the axis, -1: the ground");
  k.add(&b.bearing.stiffness, "bearing_stiffness", kPerMetre, nullptr, kStiff, "radial stiffness of the bearing; 0: rigid");
  k.add(&b.bearing.damping, "bearing_damping", Unit{"", "N s m-1"}, nullptr, kStiff, "radial damping of the bearing");
  k.add(&b.bearing.mass, "bearing_mass", Unit{"", "kg"}, nullptr, kMass, "mass of what moves with the hub; 0: rigid bearing");
  return k;
}

KeyList offset_keys(System::Body& b) {
  KeyList k("offset");
  k.add(&b.offset[0], "x", kMetre, nullptr, {-1e-3, 1e-3}, "position error of the axis");
  k.add(&b.offset[1], "y", kMetre, nullptr, {-1e-3, 1e-3}, "position error of the axis");
  return k;
}

KeyList keys(System::Mesh& m) {
  KeyList k("mesh");
  constexpr const char* kSideKeys[2][4] = {{"driver_body", "driver_sense", "driver_tooth", "driver_trailing"},
                                           {"driven_body", "driven_sense", "driven_tooth", "driven_trailing"}};
  for (size_t s = 0; s < 2; ++s) {
    System::Side& own = m.side[s];
    k.add(&own.body, kSideKeys[s][0], kNone, nullptr, kNumber, "number of the body");
    k.add(&own.sense, kSideKeys[s][1], kNone, nullptr, {-1, 1}, "sense of its rotation");
    k.add(&own.first_tooth, kSideKeys[s][2], kNone, nullptr, {-(1 << 20), 1 << 20}, "its tooth in the reference pair of mesh period 0");
    k.add(choice_slot(own.flank), kSideKeys[s][3], kNone, nullptr, kSwitch, "1: its flank trails in counter-clockwise rotation");
  }
  k.add(&m.centre_distance, "centre_distance", kMetre, nullptr, {0, 10}, "distance of the axes");
  k.add(&m.direction, "direction", kRadian, nullptr, kTurn, "from the driving body's axis to the pitch point, counter-clockwise from +x");
  k.add(&m.phase, "phase", kNone, nullptr, {0, 1}, "mesh periods that it is ahead of the first mesh");
  k.add(&m.pressure_angle, "pressure_angle", kRadian, nullptr, {0, 1.5}, "working pressure angle");
  k.add(choice_slot(m.ring_drives), "ring_drives", kNone, nullptr, kSwitch, "1: the driving gear is internal");
  k.add(&m.stiffness, "stiffness", kPerMetre, nullptr, kStiff, "mean stiffness along the line of action");
  return k;
}

KeyList keys(System::Drive& d) {
  KeyList k("drive");
  k.add(&d.body, "body", kNone, nullptr, kNumber, "number of the body");
  k.choice(d.kind, "kind", nullptr, "a torque, a rotation that is held, or nothing");
  k.add(&d.torque, "torque", Unit{"", "N m"}, nullptr, {-1e30, 1e30}, "in the sense of the body's rotation");
  k.add(&d.stiffness, "stiffness", kPerMetre, nullptr, kStiff, "of what holds the rotation, at the radius; 0: rigid");
  return k;
}
// clang-format on

}  // namespace whine
