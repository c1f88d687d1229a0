#include "io/keys.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>

#include "base/error.h"
#include "io/ranges.h"
#include "io/suggestion.h"

namespace whine {
namespace {

constexpr const char* kLargestAngle = "_largest_angle";

}  // namespace

const KeyList& scene_keys() {
  static struct {
    std::string title, error_file, bearing_gear;
    GearDesign design;
    GearWords words;
    FlankModification modification;
    ToothErrors errors;
    Material material;
    GearMeshSpec mesh;
    Bearing bearing;
    Damping damping;
    Operation operation;
    Fidelity fidelity;
    BodyDiscretisation body;
    ContactDiscretisation contact;
    TimeDiscretisation time;
    double equivalent_mass = 0;
    SystemScene::Mesh train_mesh;
    SystemScene::Carrier carrier;
    SystemScene::Drive drive;
  } v;
  static const KeyList list = [] {
    KeyList all = title_key(v.title);
    for (const KeyList& some : {keys(v.design, &v.words).section("gear"),
                                keys(v.modification),
                                keys(v.errors),
                                error_file_key(v.error_file),
                                keys(v.design).section("crack"),
                                keys(v.material),
                                keys(v.mesh).section("mesh"),
                                bearing_gear_key(v.bearing_gear),
                                keys(v.bearing),
                                keys(v.mesh.friction),
                                keys(v.damping),
                                keys(v.operation),
                                keys(v.fidelity),
                                keys(v.body),
                                keys(v.contact),
                                keys(v.time),
                                equivalent_mass_key(v.equivalent_mass),
                                keys(v.train_mesh),
                                keys(v.carrier),
                                keys(v.drive)})
      all.append(some);
    return all;
  }();
  return list;
}

bool of_systems(const Key& key) {
  const std::string section(key.section);
  return section == "rigid_gear" || section == "train_mesh" || section == "carrier" || section == "drive";
}

bool of_pairs(const Key& key) {
  const std::string section(key.section);
  return section == "crack" || section == "friction" || (section == "operation" && key.called("torque_Nm"));
}

namespace {

std::string scene_place_of(const Key& key, const std::string& owner) {
  const std::string section(key.section), name(key.name);
  if (section.empty()) return name;
  if (section == "gear" || section == "material") return section + "." + owner + "." + name;
  if (section == "rigid_gear") return "gear." + owner + "." + name;
  if (section == "train_mesh") return "mesh." + name;
  if (section == "modification" || section == "error" || section == "crack")
    return "gear." + owner + "." + section + "." + name;
  if (section == "bearing" && !owner.empty()) return section + "." + owner + "." + name;
  return section + "." + name;
}

}  // namespace

KeyPlace find_key(const std::string& name) {
  std::string owner;
  for (const char* group : {"gear.", "material.", "bearing."})
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

std::string exact_text(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : ", ") + exact_text(value);
  return "[" + out + "]";
}

std::string exact_text(const Points& points) {
  std::string out;
  for (const auto& [roll, removed] : points)
    out += (out.empty() ? "[" : ", [") + exact_text(roll) + ", " + exact_text(removed) + "]";
  return "[" + out + "]";
}

std::vector<Parameter> parameters_of(const Key& key) {
  std::vector<Parameter> out;
  const std::string name = key.si_name();
  const auto add = [&](const std::string& label, const auto& value) {
    out.push_back({label, key.unit.si, key.meaning, value});
  };
  const Slot& slot = key.slot;
  if (const auto* number = std::get_if<double*>(&slot)) {
    add(name, **number);
  } else if (const auto* whole = std::get_if<int*>(&slot)) {
    add(name, **whole);
  } else if (const auto* flag = std::get_if<bool*>(&slot)) {
    add(name, **flag ? 1 : 0);
  } else if (const auto* word = std::get_if<std::string*>(&slot)) {
    add(name, **word);
  } else if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) {
    add(name, key.word_in(*choice));
  } else if (const auto* plane = std::get_if<PlaneSlot>(&slot)) {
    add(name, std::string(*plane->stress ? "stress" : "strain"));
  } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    out.push_back(
        {name, "1", "1: a tip edge may touch a flank off the line of action", (*corner)->enabled ? 1 : 0});
    if (std::isfinite((*corner)->largest_angle)) {
      out.push_back(
          {name + kLargestAngle, "rad", "largest angle between the two normals", (*corner)->largest_angle});
    }
  } else if (const auto* range = std::get_if<RangeSlot>(&slot)) {
    add(name + "_from", *range->from);
    add(name + "_to", *range->to);
    add(name + "_step", *range->step);
  } else if (const auto* points = std::get_if<Points*>(&slot)) {
    if (!(*points)->empty()) add(name, exact_text(**points));
  } else if (const auto* list = std::get_if<ToothList>(&slot)) {
    if (!list->values->empty()) add(name, exact_text(*list->values));
  } else {
    fail(Failure::numerical, "the key ", name, " is a list, which /parameters does not hold");
  }
  return out;
}

namespace {

// Of a list that is kept as text; none if it is not there.
std::vector<double> numbers_in(const ParameterSource& source, const std::string& name) {
  std::vector<double> numbers;
  const std::string word = source.has(name) ? source.word(name) : "";
  for (const char* at = word.c_str(); *at;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end != at) numbers.push_back(number);
    at = end != at ? end : at + 1;
  }
  return numbers;
}

}  // namespace

namespace {

// A limit of a key, to the rounding of its unit, as a limit in SI.
Range si_range(const Key& key) {
  constexpr double kRoundOff = 1e-9;
  const double least = key.limits.or_zero ? 0 : key.to_si(key.limits.least),
               most = key.to_si(key.limits.most);
  return {least - kRoundOff * std::abs(least), most + kRoundOff * std::abs(most), key.limits.open};
}

double in_range(const Key& key, const ParameterSource& source, const std::string& name, double value) {
  // body = "full" takes every mode; a body that only statics use may have none.
  if (std::string(key.name) == "modes" && (value == kAllModes || value == 0)) return value;
  if (key.limits.most > key.limits.least)
    if (const std::string why = outside(si_range(key), value); !why.empty()) source.reject(name, why);
  return value;
}

std::string one_of(const std::string& choices, const ParameterSource& source, const std::string& name) {
  const std::string word = source.word(name);
  std::istringstream all(choices);
  for (std::string choice; all >> choice;)
    if (choice == word) return word;
  if (!choices.empty()) source.reject(name, "is '" + word + "', which is none of: " + choices);
  return word;
}

}  // namespace

void set_parameter(const Key& key, const ParameterSource& source) {
  const std::string name = key.si_name();
  const Slot& slot = key.slot;
  if (const auto* number = std::get_if<double*>(&slot)) {
    **number = in_range(key, source, name, source.number(name));
  } else if (const auto* whole = std::get_if<int*>(&slot)) {
    **whole = static_cast<int>(in_range(key, source, name, source.whole(name)));
  } else if (const auto* flag = std::get_if<bool*>(&slot)) {
    **flag = source.whole(name) != 0;
  } else if (const auto* word = std::get_if<std::string*>(&slot)) {
    **word = one_of(key.choices, source, name);
  } else if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) {
    key.assign(*choice, one_of(key.choices, source, name));
  } else if (const auto* plane = std::get_if<PlaneSlot>(&slot)) {
    *plane->stress = one_of(key.choices, source, name) == "stress";
  } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    (*corner)->enabled = source.whole(name) != 0;
    (*corner)->largest_angle =
        source.has(name + kLargestAngle)
            ? in_range(key, source, name + kLargestAngle, source.number(name + kLargestAngle))
            : std::numeric_limits<double>::infinity();
  } else if (const auto* range = std::get_if<RangeSlot>(&slot)) {
    *range->from = source.number(name + "_from");
    *range->to = source.number(name + "_to");
    *range->step = source.number(name + "_step");
  } else if (const auto* points = std::get_if<Points*>(&slot)) {
    (*points)->clear();
    const std::vector<double> numbers = numbers_in(source, name);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      (*points)->push_back({numbers[i], numbers[i + 1]});
  } else if (const auto* list = std::get_if<ToothList>(&slot)) {
    *list->values = numbers_in(source, name);
    for (const double item : *list->values) in_range(key, source, name, item);
  } else {
    fail(Failure::numerical, "the key ", name, " is a list, which /parameters does not hold");
  }
}

std::string scene_key_table() {
  const auto shown = [](double value) { return text(value); };
  std::ostringstream out;
  out << "| section | key | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : scene_keys()) {
    const std::string section(key.section);
    std::string label = "[" + section + "]";
    if (section.empty()) label = "(top)";
    if (section == "gear" || section == "material") label = "[" + section + ".<name>]";
    if (section == "rigid_gear") label = "[gear.<name>]";
    if (section == "train_mesh") label = "[[mesh]]";
    if (section == "modification" || section == "error" || section == "crack")
      label = "[gear.<name>." + section + "]";
    if (section == "mesh" || section == "bearing" || section == "carrier" || section == "drive")
      label = "[[" + section + "]]";
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
    out << "| `" << label << "` | `" << key.name << "` | " << fallback << " | " << range << " | "
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
