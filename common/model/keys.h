// What keys say each struct of the model, once: name, unit, default, range, meaning, and the member that holds the value. Scenes,
// stage parameters, /parameters of artifacts, the printed table of keys and studies all walk these lists.
#pragma once
#include <array>
#include <initializer_list>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "model/scene.h"

namespace whine {

struct RangeSlot {
  double *from, *to, *step;
};
using Points = std::vector<std::array<double, 2>>;  // rad, m: in a scene degrees and micrometres
struct ChoiceSlot {  // of an enumeration or a switch; a place counts from 0 in the key's choices
  void* value;
  int (*place)(const void*);
  void (*assign)(void*, int);
};
template <class Choice>
ChoiceSlot choice_slot(Choice& choice) {
  return {&choice, [](const void* at) { return static_cast<int>(*static_cast<const Choice*>(at)); },
          [](void* at, int place) { *static_cast<Choice*>(at) = static_cast<Choice>(place); }};
}
// Where a key's value is, and thereby its type.
using Slot = std::variant<double*, int*, bool*, std::string*, ChoiceSlot, CornerRule*, std::vector<double>*,
                          RangeSlot, Points*>;
// What is there, in SI: of a choice its word, or its place if the key has no words; of a corner rule a switch or its largest
// angle; of a range its three numbers.
using Value = std::variant<bool, int, double, std::string, std::vector<double>, Points>;

template <class... Case>
struct Overloaded : Case... {
  using Case::operator()...;
};
template <class... Case>
Overloaded(Case...) -> Overloaded<Case...>;

// SI = value * multiply / divide; two factors because 3.0 / 1000 is the double nearest to 0.003 and 3.0 *
// 0.001 is not always.
struct Unit {
  const char* suffix;  // of the key's name in a scene: "_mm"
  const char* si;      // UDUNITS form
  double multiply = 1, divide = 1;
  const char* spelt = "";  // as messages and figures have it, if it is not the suffix: "N/µm"

  std::string in_words() const;  // "" of numbers without unit
};

// Range in the scene's unit; of a range of speeds: of its two ends. None if `most` is not above `least`.
struct Limits {
  double least = 0, most = 0;
  bool open = false;        // least itself is not allowed
  const char* reason = "";  // why there is the lower limit, where that is not plain
  bool or_zero = false;     // 0 is allowed below the range
};

struct Key {
  const char* section;  // as in the scene: "gear", "material", "mesh", ...
  const char* name;     // in a scene, with the unit's suffix
  Unit unit;
  // Default in the scene's unit; nullptr: the key is required; "module / 6": see take_module().
  const char* fallback;
  Limits limits;
  const char* meaning;  // one line
  Slot slot;
  const char* choices = "";  // of a word, blank between; "" for numbers
  const char* each = "";     // what a list has a number for each of; "": it is one number or several
  // Section of stage parameters and artifacts, if it is not the one that is read or written: "friction"; "_rim" follows that one's
  // name in artifacts and is [rim] in stage parameters.
  std::string own = "";
  // Stage parameters and artifacts hold the keys of an optional group together, or none of them; 0: the key is always held.
  int group = 0;
  bool stands = true;            // a group is written
  const bool* unless = nullptr;  // if this is true the key has no meaning, and is neither written nor read

  Value value() const;
  void take_fallback() const;                                             // of a key that has one
  void assign(const ChoiceSlot& choice, const std::string& word) const {  // which is one of `choices`
    choice.assign(choice.value, place_of(choices, word).value());
  }
  std::string si_name() const;  // name without the unit's suffix
  double to_si(double value) const { return value * unit.multiply / unit.divide; }
  bool called(const char* word) const { return name == std::string(word); }
};

class KeyList {
 public:
  KeyList() = default;
  explicit KeyList(const char* section) : section_(section) {}

  Key& add(Slot slot, const char* name, const Unit& unit, const char* fallback, const Limits& limits,
           const char* meaning);
  void add(const Key& key) { keys_.push_back(key); }
  template <WordedChoice Choice>
  Key& choice(Choice& value, const char* name, const char* fallback, const char* meaning) {
    Key& key = add(choice_slot(value), name, Unit{"", "1"}, fallback, {}, meaning);
    key.choices = kWordsOf<Choice>;
    return key;
  }
  // Keys that follow are of this section of a scene, or an optional group, in a section `own` or "".
  void in_section(const char* section) { section_ = section; }
  void begin_group(bool stands, const std::string& own = "");
  // Those of another list; as an optional group, if it has no groups itself.
  KeyList& append(const KeyList& other);
  void append_group(const KeyList& other, bool stands, const std::string& own);

  // Parts of the list: of a section of a scene, by name, those that are in no optional group.
  KeyList section(const std::string& section) const;
  KeyList only(std::initializer_list<const char*> names) const;
  KeyList without(std::initializer_list<const char*> names) const;
  KeyList plain() const;
  // The same list, all of it held always; under the label `own` in stage parameters.
  KeyList all() const;
  KeyList labelled(const std::string& own) const;

  const Key& operator[](std::size_t i) const { return keys_[i]; }
  std::size_t size() const { return keys_.size(); }
  auto begin() const { return keys_.begin(); }
  auto end() const { return keys_.end(); }

 private:
  template <class Takes>
  KeyList those(const Takes& takes) const;

  std::vector<Key> keys_;
  const char* section_ = "";
  std::string own_;
  int groups_ = 0, group_ = 0;
  bool stands_ = true;
};

// Lengths whose default goes with the module, so that a scene that leaves them open has the same error at every module: they are 0
// until the gear is known whose module it is (m), and then have their default.
void take_module(const KeyList& keys, double module);

// What [gear.<name>] says beside the design.
struct GearWords {
  std::string like, material;                  // names of other sections
  double total_inertia = 0;                    // kg m2
  double tip_diameter = 0, root_diameter = 0;  // m; 0: addendum and dedendum say them
};

KeyList keys(GearDesign& design, GearWords* words = nullptr);  // with the crack, in a section of its own
KeyList keys(FlankModification& modification);                 // of the profile
KeyList keys(LeadModification& modification);
KeyList keys(ToothErrors& errors);
KeyList keys(Material& material);
KeyList keys(Bearing& bearing);
KeyList keys(Friction& friction);
// With what [friction], modifications, errors and bearings say of the gears, in sections of their own.
KeyList keys(GearMeshSpec& mesh);
KeyList keys(Damping& damping);
KeyList keys(Operation& operation);
KeyList keys(Fidelity& fidelity);
KeyList keys(BodyDiscretisation& body);  // of the plane body
KeyList keys(WidthDiscretisation& width);
KeyList keys(ContactDiscretisation& contact);
KeyList keys(TimeDiscretisation& time);
KeyList keys(Scene::Mesh& mesh);  // what a mesh of a system has beside `spec`
KeyList keys(Scene::Carrier& carrier);
KeyList keys(Scene::Pin& pin);
KeyList keys(Scene::Drive& drive);
KeyList keys(System::Body& body);
KeyList offset_keys(System::Body& body);  // its position error
KeyList keys(System::Mesh& mesh);
KeyList keys(System::Drive& drive);

// Keys whose value is no member of one of these.
KeyList title_key(std::string& title);
KeyList inertia_key(double& total_inertia);
KeyList equivalent_mass_key(double& equivalent_mass);  // of a gear of a rigid system
KeyList error_file_key(std::string& file);
KeyList bearing_gear_key(std::string& gear);
KeyList torque_key(std::vector<double>& torques);
KeyList speeds_key(MeshSpeeds& speeds);

// Units of the two numbers of a point.
extern const std::array<Unit, 2> kPointUnits;

}  // namespace whine
