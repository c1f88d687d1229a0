#include "io/system_keys.h"

namespace whine {

std::vector<Key> system_keys() {
  using namespace units;
  using V = SceneParameters;
  // clang-format off
  return {
    {KeyGroup::rigid_gear, "rigid_gear", "equivalent_mass_kg", kKilogram, "0.0", 0, 1e9, false, "",
     "of a system with body = \"rigid\": inertia over the square of the base radius, in place of total_inertia_kgm2; 0: not given",
     [](V& v) -> Slot { return &v.equivalent_mass; }},
    {KeyGroup::train_mesh, "train_mesh", "direction_deg", kDegree, "90", -360, 360, false, "",
     "of a system: from the driver's axis to the pitch point, counter-clockwise from +x; without meaning where a planet takes part, whose positions say it",
     [](V& v) -> Slot { return &v.train_mesh.direction; }},
    {KeyGroup::train_mesh, "train_mesh", "stiffness_N_um", kNewtonPerMicrometre, "0.0", 0, 1e6, false, "",
     "of a system with body = \"rigid\", which needs it: mean stiffness along the line of action",
     [](V& v) -> Slot { return &v.train_mesh.stiffness; }},
    {KeyGroup::carrier, "carrier", "name", kNone, nullptr, 0, 0, false, "",
     "name of the carrier, for [[bearing]] and [[drive]]",
     [](V& v) -> Slot { return &v.carrier.name; }},
    {KeyGroup::carrier, "carrier", "planet", kNone, nullptr, 0, 0, false, "",
     "name of the gear that it carries at each position; a [[mesh]] or [[bearing]] of this gear is one of each planet, its bearing a pin of the carrier",
     [](V& v) -> Slot { return &v.carrier.planet; }},
    {KeyGroup::carrier, "carrier", "planets", kNone, "0", 0, 100, false, "",
     "number of planets at equal spacing; it must divide the sum of the teeth of sun and ring",
     [](V& v) -> Slot { return &v.carrier.planets; }},
    {KeyGroup::carrier, "carrier", "positions_deg", kDegree, "", -360, 360, false, "",
     "in place of planets: a list of angles, counter-clockwise from +x, that are apart by multiples of 360 over the teeth of sun and ring, to a twentieth of that step",
     [](V& v) -> Slot { return ToothList{&v.carrier.positions, "planet"}; }},
    {KeyGroup::carrier, "carrier", "inertia_kgm2", kInertia, "0.0", 0, 1e9, false, "",
     "inertia of the carrier about its axis; with planets on rigid pins their masses included",
     [](V& v) -> Slot { return &v.carrier.inertia; }},
    {KeyGroup::carrier, "carrier", "equivalent_mass_kg", kKilogram, "0.0", 0, 1e9, false, "",
     "inertia over the square of the radius of the pins, in place of inertia_kgm2, of the same masses; 0: not given",
     [](V& v) -> Slot { return &v.carrier.equivalent_mass; }},
    {KeyGroup::drive, "drive", "gear", kNone, nullptr, 0, 0, false, "",
     "name of the gear or carrier that it acts on; one without a drive is free of torque",
     [](V& v) -> Slot { return &v.drive.gear; }},
    {KeyGroup::drive, "drive", "kind", kNone, nullptr, 0, 0, false, kWordsOf<System::DriveKind>,
     "a torque, a rotation that is held, or nothing",
     [](V& v) -> Slot { return choice_slot(v.drive.kind); }},
    {KeyGroup::drive, "drive", "torque_Nm", kNewtonMetre, "0.0", -1e7, 1e7, false, "",
     "of kind torque, positive in the sense in which the body turns",
     [](V& v) -> Slot { return &v.drive.torque; }},
    {KeyGroup::drive, "drive", "stiffness_N_um", kNewtonPerMicrometre, "0.0", 0, 1e6, false, "",
     "of kind held: stiffness of what holds the rotation, at the base radius, of a carrier at that of its pins; 0: rigid",
     [](V& v) -> Slot { return &v.drive.stiffness; }},
  };
  // clang-format on
}

}  // namespace whine
