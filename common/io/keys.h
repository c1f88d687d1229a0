// The one table of all scene keys. The scene reader, the stage parameters, /parameters in the artifacts and the printed
// key table all walk it, so that a key's name, unit, range, default and meaning stand in one place.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "io/scene.h"
#include "model/system_scene.h"

namespace whine {

// Everything that keys fill, once each; a scene has several gears and reads them one after the other.
struct SceneParameters {
  std::string title;
  std::string like, material_name;             // of a gear
  double total_inertia = 0;                    // kg m2, of a gear
  double tip_diameter = 0, root_diameter = 0;  // m, of a gear; 0: addendum and dedendum say them
  GearDesign design;
  FlankModification modification;
  ToothErrors errors;
  std::string error_file;
  Bearing bearing;
  std::string bearing_gear;
  double equivalent_mass = 0;  // kg, of a gear of a rigid system
  SystemScene::Carrier carrier;
  SystemScene::Drive drive;
  SystemScene::Mesh train_mesh;  // what a mesh of a system has beside `mesh`
  Material material;
  GearMeshSpec mesh;
  Damping damping;
  Operation operation;
  Fidelity fidelity;
  BodyDiscretisation body;
  ContactDiscretisation contact;
  TimeDiscretisation time;
};

// Keys that travel together: stage parameters or an artifact hold whole parts.
enum class KeyGroup {
  title,
  reference,  // like, material: names of other sections
  design,
  bore,         // of an external gear's design
  rim,          // of an internal gear's design; stage parameters or an artifact hold it in place of the bore
  rim_support,  // of a rim; stage parameters or an artifact hold it only where it is elastic
  diameter,     // other words for parts of a design, in a scene alone
  crack,        // of a design; stage parameters or an artifact hold it only where there is one
  inertia,
  modification,
  error,
  error_file,
  bearing,
  bearing_gear,  // whose it is, in a scene alone
  rigid_gear,    // this and the next three: of systems, in a scene alone
  carrier,
  drive,
  train_mesh,
  material,
  mesh,
  contact_plane,  // of a mesh; stage parameters or an artifact hold it only where it is not that of the bodies
  friction,       // of a mesh; stage parameters or an artifact hold it only where it acts
  damping,
  load,           // torque
  operation,      // speeds
  level,          // body and integrator
  contact_level,  // contact
  body,
  near_field,  // of a body; stage parameters hold it only where it is not the default
  contact,
  time
};

struct PlaneSlot {
  bool* stress;
};
struct RangeSlot {
  double *from, *to, *step;
};
using Points = std::vector<std::array<double, 2>>;  // rad, m: in a scene degrees and micrometres
struct ToothList {                                  // a number for each tooth, or none
  std::vector<double>* values;
  const char* of = "tooth";  // or of what else there is one for each
};
struct ChoiceSlot {  // of an enumeration; a place counts from 0 in the key's choices
  void* value;
  int (*place)(const void*);
  void (*assign)(void*, int);
};
template <WordedChoice Choice>
ChoiceSlot choice_slot(Choice& choice) {
  return {&choice, [](const void* at) { return static_cast<int>(*static_cast<const Choice*>(at)); },
          [](void* at, int place) { *static_cast<Choice*>(at) = static_cast<Choice>(place); }};
}
// Where a key's value lives, and thereby its type.
using Slot = std::variant<double*, int*, bool*, std::string*, ChoiceSlot, CornerRule*, PlaneSlot,
                          std::vector<double>*, RangeSlot, Points*, ToothList>;

// SI = value * multiply / divide; two factors because 3.0 / 1000 is the double nearest to 0.003 and 3.0 *
// 0.001 is not always.
struct Unit {
  const char* suffix;  // of the key's name in a scene: "_mm"
  const char* si;      // UDUNITS form
  double multiply = 1, divide = 1;
};

// Those that both tables of keys, of pairs and of systems, have.
namespace units {
inline constexpr Unit kNone{"", "1"}, kDegree{"_deg", "rad", std::numbers::pi, 180},
    kInertia{"_kgm2", "kg m2"}, kKilogram{"_kg", "kg"}, kNewtonMetre{"_Nm", "N m"},
    kNewtonPerMicrometre{"_N_um", "N m-1", 1e6};
}  // namespace units

struct Key {
  KeyGroup part;
  const char* section;  // as in the scene: "gear", "material", "mesh", ...
  const char* name;     // in a scene, with the unit's suffix
  Unit unit;
  // Default in the scene's unit; nullptr: the key is required; "module / 6": see io/module_lengths.h.
  const char* fallback;
  double least, most;   // range in the scene's unit; of a range of speeds: of its two ends
  bool open;            // least itself is not allowed
  const char* choices;  // of a word, blank between; "" for numbers
  const char* meaning;  // one line
  Slot (*slot)(SceneParameters&);
  const char* reason = "";  // why there is the lower limit, where that is not plain
  bool or_zero = false;     // 0 is allowed below the range

  // The word of a choice, and a choice by its word, which is one of `choices`.
  std::string word_in(const ChoiceSlot& slot) const { return word_at(choices, slot.place(slot.value)); }
  void assign(const ChoiceSlot& slot, const std::string& word) const {
    slot.assign(slot.value, place_of(choices, word).value());
  }
  std::string si_name() const;  // name without the unit's suffix
  double to_si(double value) const { return value * unit.multiply / unit.divide; }
};

const std::vector<Key>& scene_keys();

// A key by its name ("bore_radius_mm") or by its place in a scene ("gear.pinion.bore_radius_mm",
// "gear.pinion.modification.tip_relief_um", "damping.rayleigh_stiffness_s"). Error(usage), by the nearest one, if no scene has
// it there.
struct KeyPlace {
  const Key* key;
  std::string owner;  // the one gear or material; "": a key alone means all of them
};
KeyPlace find_key(const std::string& name);

// Shortest text that reads back as the same double; always a TOML float.
std::string exact_text(double value);
std::string exact_text(const Points& points);
std::string exact_text(const std::vector<double>& values);  // [1.0, 2.0]

// What a mesh says of a gear beside the drawing: a section for each gear, which stands only where something is said.
struct GearSection {
  const char* name;  // as in a scene; that of a gear is "driver_modification"
  KeyGroup part;
  const char* first;                               // dataset that is there if the section is
  bool (*stands)(const SceneParameters& of_gear);  // not for gears as they are drawn, on rigid axes

  std::string of(int g) const { return std::string(kRole[g]) + "_" + name; }
};
extern const std::array<GearSection, 3> kGearSections;

// Whether keys of a part are those of systems, which pairs do not have.
inline bool of_systems(KeyGroup part) {
  return part == KeyGroup::rigid_gear || part == KeyGroup::carrier || part == KeyGroup::drive ||
         part == KeyGroup::train_mesh;
}

// Whether keys of a part are those of pairs, which scenes of systems reject; the table of keys says so.
inline bool of_pairs(KeyGroup part) {
  return part == KeyGroup::crack || part == KeyGroup::friction || part == KeyGroup::load;
}

// What such sections hold of gear g of a mesh, into the values and back.
void take_gear(SceneParameters& values, const GearMeshSpec& mesh, int g);
void put_gear(const SceneParameters& values, GearMeshSpec& mesh, int g);

// Units of the two numbers of a point.
extern const std::array<Unit, 2> kPointUnits;

// One value for /parameters/<section>/<name>.
struct Parameter {
  std::string name, units, meaning;
  std::variant<double, int, std::string> value;
};

// The values of a part, and back. A limit that is infinite is left out and read back as infinite.
std::vector<Parameter> parameters_of(const SceneParameters& values, KeyGroup part);

class ParameterSource {
 public:
  virtual ~ParameterSource() = default;
  virtual bool has(const std::string& name) const = 0;
  virtual double number(const std::string& name) const = 0;
  virtual int whole(const std::string& name) const = 0;
  virtual std::string word(const std::string& name) const = 0;
  // Throws Error(input) that names the source, the parameter and what is wrong with it.
  [[noreturn]] virtual void reject(const std::string& name, const std::string& what) const = 0;
};
// Values outside of the range of their key are rejected.
void set_parameters(SceneParameters& values, KeyGroup part, const ParameterSource& source);

}  // namespace whine
