#include "io/keys.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <sstream>

#include "base/error.h"
#include "io/suggestion.h"

namespace whine {
const KeyList& scene_keys() {
  static struct {
    std::string error_file, bearing_gear;
    GearWords words;
    SceneGear gear;
    Scene scene;
    Scene::Mesh mesh;
    Scene::Carrier carrier;
    Scene::Pin pin;
    Scene::Drive drive;
  } v;
  static const KeyList list = [] {
    GearDesign& design = v.gear.design;
    KeyList all = title_key(v.scene.title);
    for (const KeyList& some : {keys(design, &v.words).section("gear"),
                                keys(v.gear.modification),
                                keys(v.gear.modification.lead),
                                keys(v.gear.errors),
                                error_file_key(v.error_file),
                                keys(design).section("crack"),
                                keys(v.gear.material),
                                keys(v.mesh.spec).section("mesh"),
                                bearing_gear_key(v.bearing_gear),
                                keys(v.gear.bearing),
                                keys(v.mesh.spec.friction),
                                keys(v.scene.damping),
                                keys(v.scene.operation),
                                keys(v.scene.fidelity),
                                keys(v.scene.body),
                                keys(v.scene.body.width),
                                keys(v.scene.contact),
                                keys(v.scene.time),
                                equivalent_mass_key(v.gear.equivalent_mass),
                                keys(v.mesh),
                                keys(v.carrier),
                                keys(v.pin),
                                keys(v.drive)})
      all.append(some);
    return all;
  }();
  return list;
}

bool of_systems(const Key& key) {
  const std::string section(key.section);
  return section == "rigid_gear" || section == "train_mesh" || section == "carrier" || section == "pin" ||
         section == "drive";
}

bool of_pairs(const Key& key) {
  const std::string section(key.section);
  return (section == "operation" && key.called("torque_Nm")) || key.called("width_degree") ||
         key.called("section_element_mm") || key.called("face_offset_mm");
}

namespace {

constexpr std::array kLists{"mesh", "bearing", "carrier", "pin", "drive"};
bool in_list(const std::string& path) {
  return std::find(kLists.begin(), kLists.end(), path) != kLists.end();
}

// "gear.<name>.crack".
std::string path_of(const Key& key) {
  const std::string section(key.section);
  if (section == "gear" || section == "material") return section + ".<name>";
  if (section == "modification" || section == "error" || section == "crack") return "gear.<name>." + section;
  return section == "rigid_gear" ? "gear.<name>" : section == "train_mesh" ? "mesh" : section;
}

std::string scene_place_of(const Key& key, const std::string& owner) {
  std::string path = path_of(key);
  if (path.empty()) return key.name;
  if (const auto name = path.find("<name>"); name != std::string::npos) path.replace(name, 6, owner);
  if (in_list(path) && !owner.empty()) path += "." + owner;
  return path + "." + key.name;
}

}  // namespace

std::string heading_of(const Key& key) {
  const std::string path = path_of(key);
  if (in_list(path)) return "[[" + path + "]]";
  return path.empty() ? "(top)" : "[" + path + "]";
}

KeyPlace find_key(const std::string& name) {
  std::string owner;
  for (const char* group : {"gear.", "material.", "mesh.", "bearing.", "carrier.", "pin.", "drive."})
    if (name.rfind(group, 0) == 0) {
      const auto from = std::string(group).size(), to = name.find('.', from);
      if (to != std::string::npos) owner = name.substr(from, to - from);
    }
  const bool placed = name.find('.') != std::string::npos;
  std::vector<std::string> known;
  for (const Key& key : scene_keys()) {
    const std::string candidate = placed ? scene_place_of(key, owner) : key.name;
    if (candidate == name) return {&key, placed ? owner : ""};
    known.push_back(candidate);
  }
  // A right key in a wrong place, or a word for one, is nearer than any key that is spelt alike there.
  const std::string last = name.substr(name.rfind('.') + 1);
  std::string note, near;
  const Key* meant = meant_key(last, note);
  if (!meant && !note.empty()) fail(Failure::usage, "no scene has the key '", name, "': ", note);
  if (meant && (!placed || last == meant->name || !note.empty() || nearest(name, known).empty()))
    near = placed ? scene_place_of(*meant, owner.empty() ? "<name>" : owner) : meant->name;
  if (near.empty()) near = nearest(name, known);
  fail(Failure::usage, "no scene has the key '", name, "'",
       near.empty()   ? "; gear-scene --keys lists them"
       : note.empty() ? "; did you mean '" + near + "'?"
                      : "; did you mean '" + near + "' (" + note + ")?");
}

std::string exact_text(double value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string out(buffer, end);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";
  return out;
}

std::string value_text(const Key& key, const NumberText& number, const char* quote) {
  const auto own = [&](double si) { return number(si, key.unit); };
  const auto listed = [](const auto& items, const auto& word_of) {
    std::string out;
    for (const auto& item : items) out += (out.empty() ? "" : ", ") + word_of(item);
    return "[" + out + "]";
  };
  const auto point = [&](const auto& at) {
    return "[" + number(at[0], kPointUnits[0]) + ", " + number(at[1], kPointUnits[1]) + "]";
  };
  if (const auto* range = std::get_if<RangeSlot>(&key.slot))
    return "{ from = " + own(*range->from) + ", to = " + own(*range->to) + ", step = " + own(*range->step) +
           " }";
  return std::visit(Overloaded{[](bool on) { return std::string(on ? "true" : "false"); },
                               [](int whole) { return std::to_string(whole); }, own,
                               [&](const std::string& word) {
                                 std::string out;
                                 for (const char c : word) {
                                   if (*quote && (c == '"' || c == '\\')) out += '\\';
                                   out += c;
                                 }
                                 return quote + out + quote;
                               },
                               [&](const std::vector<double>& list) { return listed(list, own); },
                               [&](const Points& points) { return listed(points, point); }},
                    key.value());
}

std::string exact_value(const Key& key, const char* quote) {
  return value_text(
      key, [](double si, const Unit&) { return exact_text(si); }, quote);
}

std::string scene_key_table() {
  const auto shown = [](double value) { return text(value); };
  std::ostringstream out;
  out << "| section | key | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : scene_keys()) {
    std::string range = "text";
    if (std::holds_alternative<bool*>(key.slot)) {
      range = "true/false";
    } else if (*key.choices) {
      range = key.choices;
      std::replace(range.begin(), range.end(), ' ', '/');
    } else if (key.limits.most > key.limits.least) {
      range = key.limits.open ? "> " + shown(key.limits.least) + ", <= " + shown(key.limits.most)
                              : (key.limits.or_zero ? "0, " : "") + shown(key.limits.least) + " to " +
                                    shown(key.limits.most);
    }
    if (std::holds_alternative<CornerRule*>(key.slot)) range = "true, false, or " + range + " (degrees)";
    const std::string fallback = !key.fallback ? "required" : *key.fallback ? key.fallback : "none";
    out << "| `" << heading_of(key) << "` | `" << key.name << "` | " << fallback << " | " << range << " | "
        << (of_pairs(key) ? "of pairs alone: " : "") << key.meaning << " |\n";
  }
  return out.str();
}

void read_held(const KeyList& list, const std::function<bool(const Key&)>& has,
               const std::function<std::string(const Key&)>& section_of,
               const std::function<void(const std::string& section, const KeyList&)>& read) {
  std::set<int> there;
  for (const Key& key : list)
    if (key.group > 0 && has(key)) there.insert(key.group);
  for (const bool optional : {true, false}) {
    std::vector<std::pair<std::string, KeyList>> sections;
    for (const Key& key : list) {
      if (optional ? !there.contains(key.group) : key.group > 0 || (key.unless && *key.unless)) continue;
      const std::string section = section_of(key);
      if (sections.empty() || sections.back().first != section) sections.emplace_back(section, KeyList());
      sections.back().second.add(key);
    }
    for (const auto& [section, keys] : sections) read(section, keys);
  }
}

}  // namespace whine
