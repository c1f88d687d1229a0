// Values of keys as files have them: their place in a scene, their text, their datasets.
//
// Private to the layer io/.
#pragma once
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "io/scene.h"
#include "model/keys.h"

namespace whine {

// The keys of all sections of scenes, of values that nobody else has.
const KeyList& scene_keys();

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

// What a key holds as a scene has it, its numbers as `number` writes them; quote: around words.
using NumberText = std::function<std::string(double si, const Unit&)>;
std::string value_text(const Key& key, const NumberText& number, const char* quote);
// The same in SI with all digits.
std::string exact_value(const Key& key, const char* quote);

// Where a scene has the key: "[gear.<name>.crack]", "[[mesh]]"; "(top)".
std::string heading_of(const Key& key);

// Whether a key is one of systems, which pairs do not have, or one of pairs, which scenes of systems reject; the table of keys says
// so.
bool of_systems(const Key& key);
bool of_pairs(const Key& key);

// One value for /parameters/<section>/<name>.
struct Parameter {
  std::string name, units, meaning;
  std::variant<double, int, std::string> value;
};

// What a key holds, and back. A limit that is infinite is left out and read back as infinite.
std::vector<Parameter> parameters_of(const Key& key);

// Whether stage parameters and artifacts hold the key.
inline bool is_held(const Key& key) {
  return key.stands && !(key.unless && *key.unless);
}

// Reads what a file holds of a list, section by section. Optional groups come first, since they decide what other keys mean.
void read_held(const KeyList& list, const std::function<bool(const Key&)>& has,
               const std::function<std::string(const Key&)>& section_of,
               const std::function<void(const std::string& section, const KeyList&)>& read);

}  // namespace whine
