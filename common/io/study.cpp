#include "io/study.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/key_error.h"
#include "gear/system_layout.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/section_reader.h"
#include "io/suggestion.h"
#include "io/toml.h"
#include "io/variant.h"

namespace whine {
namespace {

using Words = std::vector<std::string>;

constexpr int kMostPanels = 4;

// The torque of a pair, which is one of a list in its scene.
bool is_torque(const Key& key) {
  return key.section == std::string("operation") && key.called("torque_Nm");
}

bool among(const std::string& word, const Words& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Shortest text that reads back as the same number, as people write it: 150, 0.3, 5.5e-06.
std::string number_text(double value) {
  char buffer[40];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
    if (std::strtod(buffer, nullptr) == value) break;
  }
  return buffer;
}

// A value as a scene has it, on one line.
std::string toml_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* list = node.as_array()) {
    std::string out;
    for (const toml::node& item : *list) out += (out.empty() ? "" : ", ") + toml_text(item);
    return "[" + out + "]";
  }
  if (const auto* table = node.as_table()) {
    std::string out;
    for (const auto& [name, item] : *table)
      out += (out.empty() ? " " : ", ") + std::string(name.str()) + " = " + toml_text(item);
    return "{" + out + " }";
  }
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  std::string word = out.str();
  std::replace(word.begin(), word.end(), '\n', ' ');
  return word;
}

// Numbers that ranges step through and draws end in, without the last digits that binary fractions leave.
std::string rounded_text(double value, int digits, bool whole) {
  if (whole) return std::to_string(std::llround(value));
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return number_text(std::strtod(buffer, nullptr));
}

constexpr double kMostWhole = 2147483647;
constexpr int kMostKeys = 32;

class StudyFile : public Source {
 public:
  explicit StudyFile(const std::string& path) : Source(path, "check the path of the study") {}

  void require_known(const toml::table& table, const std::string& section, const Words& known) const {
    for (const auto& [name, node] : table) {
      const std::string word(name.str());
      if (among(word, known)) continue;
      const std::string now = renamed(word), near = among(now, known) ? now : nearest(word, known);
      reject_line(name.source().begin.line, "unknown key '", word, "'",
                  section.empty() ? "" : " in " + section,
                  near.empty() ? text("; known are: ", joined(known)) : text("; did you mean '", near, "'?"));
    }
  }

  // The word of a key; `fallback` where it is not given.
  std::string word(const toml::table& table, const char* key, const std::string& fallback = "") const {
    const toml::node* node = table.get(key);
    if (!node) return fallback;
    const auto* value = node->as_string();
    if (!value || value->get().empty())
      reject(*node, "'", key, "' = ", toml_text(*node), ": must be text in quotes");
    for (const unsigned char c : value->get())
      if (c < 32 || c == 127) reject(*node, "'", key, "' must be one line of text");
    return value->get();
  }

  std::string choice(const toml::table& table, const char* key, const std::string& fallback,
                     const Words& choices) const {
    const std::string chosen = word(table, key, fallback);
    if (!among(chosen, choices))
      reject(*table.get(key), "'", key, "' = ", chosen, ": must be one of: ", joined(choices));
    return chosen;
  }

  // A list of words, each of them `known` and given once; `what` they are.
  Words words(const toml::table& table, const char* key, const Words& fallback, const Words& known,
              const std::string& what) const {
    const toml::node* node = table.get(key);
    if (!node) return fallback;
    const toml::array* list = node->as_array();
    if (!list || list->empty())
      reject(*node, "'", key, "' must be a list of ", what, "s, one at least: [\"", known.front(), "\"]");
    Words out;
    for (const toml::node& item : *list) {
      const std::string word = item.value<std::string>().value_or("");
      if (!among(word, known)) {
        const std::string near = nearest(word, known);
        reject(item, "'", key, "': there is no ", what, " ", toml_text(item),
               near.empty() ? text("; there are: ", joined(known)) : text("; did you mean '", near, "'?"));
      }
      if (among(word, out)) reject(item, "'", key, "' names '", word, "' twice");
      out.push_back(word);
    }
    return out;
  }

  double number(const toml::table& table, const char* key) const {
    const toml::node& node = *table.get(key);
    const double value = node.is_number() ? node.value<double>().value_or(NAN) : NAN;
    if (!std::isfinite(value)) reject(node, "'", key, "' = ", toml_text(node), ": must be a finite number");
    return value;
  }

  long whole(const toml::table& table, const char* key, long least, long most) const {
    const toml::node& node = *table.get(key);
    const auto* value = node.as_integer();
    if (!value || value->get() < least || value->get() > most)
      reject(node, "'", key, "' = ", toml_text(node), ": must be a whole number from ", least, " to ", most);
    return static_cast<long>(value->get());
  }
};

void read_values(const StudyFile& file, const toml::table& table, VariedKey& varied) {
  const toml::node& node = *table.get("values");
  const toml::array* list = node.as_array();
  if (!list || list->empty()) file.reject(node, "'values' must be a list of one value at least");
  std::set<std::string> seen;
  for (const toml::node& item : *list) {
    if (varied.number && (!item.is_number() || (varied.whole && !item.is_integer())))
      file.reject(item, "'values' of ", varied.name, " holds ", toml_text(item), ": must be a ",
                  varied.whole ? "whole number" : "number");
    // 150 and 150.0 are one torque.
    const std::string value =
        varied.number && !varied.whole ? number_text(item.value<double>().value_or(0)) : toml_text(item);
    if (!seen.insert(value).second)
      file.reject(item, "'values' of ", varied.name, " holds ", toml_text(item), " twice");
    varied.values.push_back(value);
  }
}

void require_size(const StudyFile& file, const toml::table& table, const VariedKey& varied) {
  if (varied.whole && !(std::abs(varied.first) <= kMostWhole && std::abs(varied.second) <= kMostWhole))
    file.reject(table, varied.name, " is a whole number: it cannot be beyond ", kMostWhole);
}

void read_range(const StudyFile& file, const toml::table& table, bool random, VariedKey& varied) {
  const char* const known = "values = [..], from and to with step or count";
  if (!varied.number) file.reject(table, varied.name, " is no number: give values = [..]");
  for (const char* end : {"from", "to"})
    if (!table.get(end)) file.reject(table, varied.name, " lacks '", end, "'; give ", known);
  varied.first = file.number(table, "from");
  varied.second = file.number(table, "to");
  require_size(file, table, varied);
  if (varied.second < varied.first)
    file.reject(*table.get("to"), "the range of ", varied.name, " is empty: 'to' = ", varied.second,
                " is below 'from' = ", varied.first);
  const bool step = table.contains("step"), count = table.contains("count");
  if (step && count)
    file.reject(*table.get("count"), varied.name, " has 'step' and 'count'; give one of them");
  if (!step && !count) {
    if (!random)
      file.reject(table, varied.name, " lacks 'step' or 'count': in a grid a range needs one of them");
    if (varied.whole &&
        (varied.first != std::floor(varied.first) || varied.second != std::floor(varied.second)))
      file.reject(table, varied.name, " is a whole number: so must be 'from' and 'to'");
    varied.least = varied.first;
    varied.most = varied.second;
    return;
  }
  const double span = varied.second - varied.first;
  double steps = 0, each = 0;
  if (count) {
    steps = static_cast<double>(file.whole(table, "count", 1, kMostVariants)) - 1;
    if (steps == 0 && span > 0)
      file.reject(*table.get("count"), "'count' of ", varied.name, " = 1, but the range has two ends");
    if (steps > 0 && span == 0)
      file.reject(*table.get("count"), "the range of ", varied.name, " holds one value only, ", varied.first);
    each = steps > 0 ? span / steps : 0;
  } else {
    each = file.number(table, "step");
    if (!(each > 0))
      file.reject(*table.get("step"), "'step' of ", varied.name, " = ", each, ": must be greater than 0");
    steps = std::floor(span / each * (1 + 1e-12) + 1e-9);
    if (!(steps < static_cast<double>(kMostVariants)))
      file.reject(*table.get("step"), "'step' of ", varied.name, " = ", each, " makes more than ",
                  kMostVariants, " values; a larger one makes fewer");
  }
  constexpr int kDigits = 12;
  for (double i = 0; i <= steps; ++i) {
    const double value = varied.first + i * each;
    if (varied.whole && std::abs(value - std::round(value)) > 1e-9)
      file.reject(table, varied.name, " is a whole number, the range holds ", value);
    varied.values.push_back(rounded_text(value, kDigits, varied.whole));
  }
}

void read_normal(const StudyFile& file, const toml::table& table, bool random, VariedKey& varied) {
  if (!random)
    file.reject(*table.get("mean"), varied.name,
                " is drawn at random, which a grid is not; say plan = \"sample\"");
  if (!varied.number) file.reject(table, varied.name, " is no number: give values = [..]");
  if (!table.get("deviation"))
    file.reject(table, varied.name, " lacks 'deviation'; give mean and deviation, least and most if need be");
  varied.normal = true;
  varied.first = file.number(table, "mean");
  varied.second = file.number(table, "deviation");
  require_size(file, table, varied);
  if (!(varied.second > 0))
    file.reject(*table.get("deviation"), "'deviation' of ", varied.name, " = ", varied.second,
                ": must be greater than 0");
  varied.least = table.contains("least") ? file.number(table, "least") : -HUGE_VAL;
  varied.most = table.contains("most") ? file.number(table, "most") : HUGE_VAL;
  // Of a narrower window draws would be rejected for ever.
  constexpr double kWidest = 3;
  if (!(varied.least < varied.most) || varied.least > varied.first + kWidest * varied.second ||
      varied.most < varied.first - kWidest * varied.second ||
      varied.most - varied.least < 0.1 * varied.second)
    file.reject(
        table, "'least' and 'most' of ", varied.name,
        " leave hardly a draw: they must be a tenth of the deviation apart and reach to within 3 deviations of the mean");
}

VariedKey read_varied(const StudyFile& file, const toml::table& table, bool random) {
  const Words normal{"mean", "deviation", "least", "most"}, range{"from", "to", "step", "count"};
  Words known{"key", "values"};
  for (const Words& more : {range, normal}) known.insert(known.end(), more.begin(), more.end());
  file.require_known(table, "[[vary]]", known);
  VariedKey varied;
  const std::string name = file.word(table, "key");
  if (name.empty()) file.reject(table, "[[vary]] lacks 'key'");
  try {
    varied = varied_key(name);
  } catch (const Error& error) {
    file.reject(*table.get("key"), error.what());
  }
  varied.line = table.get("key")->source().begin.line;
  const auto given = [&](const Words& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return table.contains(name); });
  };
  const int ways = int(table.contains("values")) + int(given(range)) + int(given(normal));
  if (ways != 1)
    file.reject(table, varied.name, ways == 0 ? " lacks its values" : " says its values in two ways",
                ": give one of values = [..], from and to (with step or count), mean and deviation");
  if (table.contains("values"))
    read_values(file, table, varied);
  else if (given(range))
    read_range(file, table, random, varied);
  else if (table.contains("mean"))
    read_normal(file, table, random, varied);
  else
    file.reject(table, varied.name, " lacks 'mean'");
  return varied;
}

// [set] may be written with dots in quotes or as the sections of a scene.
void read_fixed(const StudyFile& file, const toml::table& table, const std::string& prefix, Study& study) {
  for (const auto& [label, node] : table) {
    const std::string name = prefix + std::string(label.str());
    std::string why;
    try {
      find_key(name);
    } catch (const Error& error) {
      why = error.what();
    }
    if (!why.empty() && node.is_table() && !node.as_table()->is_inline()) {
      read_fixed(file, *node.as_table(), name + ".", study);
      continue;
    }
    if (!why.empty()) file.reject_line(label.source().begin.line, "[set]: " + why);
    study.fixed.emplace_back(name, toml_text(node));
  }
}

// Of the scene with [set].
TrainNames names_in_train(const StudyFile& file, const Study& study) {
  Words changes;
  for (const auto& [name, value] : study.fixed) changes.push_back(name + "=" + value);
  const Scene scene = read_variant_of(study.scene, scene_variant(study.scene, changes));
  const toml::node& at = *file.root().get("scene");
  if (scene.rigid())
    file.reject(at, study.scene,
                " is a train of rigid gears, which have natural modes alone; a study is of elastic gears");
  if (!study.directions.empty() && scene.operation.frequency_to == 0)
    file.reject(at, study.scene, " has no [operation] with mesh_frequency_Hz, which stage = \"sweep\" needs");
  return train_names(static_parameters_of(scene, layout_of(scene)));
}

void read_compared(const StudyFile& file, const toml::node& node, Study& study) {
  if (const toml::array* list = node.as_array())
    for (const toml::node& item : *list)
      if (const auto number = item.value<int64_t>();
          item.is_integer() && *number >= 0 && *number < study.variants)
        study.compared.push_back(static_cast<long>(*number));
  if (study.compared.size() != 2 || node.as_array()->size() != 2 || study.compared[0] == study.compared[1])
    file.reject(node, "'compare' must be the numbers of two different variants, 0 to ", study.variants - 1,
                ": compare = [0, ", study.variants - 1, "]");
}

// Whether two places may hold one number of a scene: "bore_radius_mm" is that of every gear.
bool overlap(const KeyPlace& a, const KeyPlace& b) {
  return a.key == b.key && (a.owner == b.owner || a.owner.empty() || b.owner.empty());
}

// Cells over two of the keys or quantities of a grid in place of lines.
void read_map(const StudyFile& file, const toml::table& table, Words sides, Study& study) {
  const toml::node* map = table.get("map");
  if (!map) return;
  if (study.random || study.keys.size() != 2)
    file.reject(*map, "'map' is of a grid in which two keys vary; this study is ",
                study.random ? "a sample" : text("of ", study.keys.size()));
  for (const char* other : {"keys", "colour"})
    if (table.contains(other))
      file.reject(*table.get(other), "'", other, "' is of lines, 'map' of cells; leave one of them out");
  sides.insert(sides.end(), study.quantities.begin(), study.quantities.end());
  study.figure_map = file.words(table, "map", {}, sides, "varied key or gathered response quantity");
  if (study.figure_map.size() != 2)
    file.reject(*map, "'map' names ", study.figure_map.size(),
                "; it must be two, what runs along x and along y");
}

void read_figure(const StudyFile& file, Study& study) {
  const toml::node* node = study.keys.empty() ? nullptr : file.root().get("figure");
  // A seed is a number without a size: nothing is plotted against it unless nothing else varies.
  Words names, all;
  for (const VariedKey& key : study.keys) {
    all.push_back(key.name);
    if (key.name != "seed" && !key.name.ends_with(".seed")) names.push_back(key.name);
  }
  if (names.empty()) names = all;
  const auto first = [](Words words) {
    if (words.size() > kMostPanels) words.resize(kMostPanels);
    return words;
  };
  static const toml::table kNothing;
  const toml::table* table = node ? node->as_table() : &kNothing;
  if (!table) file.reject(*node, "'figure' must be a section: write [figure]");
  file.require_known(*table, "[figure]", {"quantities", "keys", "colour", "map"});
  study.figure_quantities = file.words(*table, "quantities", first(study.quantities), study.quantities,
                                       "gathered response quantity");
  study.figure_keys = file.words(*table, "keys", first(names), names, "varied key");
  for (const auto& [what, list] :
       {std::pair{"quantities", &study.figure_quantities}, std::pair{"keys", &study.figure_keys}})
    if (list->size() > kMostPanels)
      file.reject(*table->get(what), "'", what, "' in [figure] names ", list->size(),
                  "; a figure has room for ", kMostPanels);
  read_map(file, *table, names, study);
  study.figure_colour = file.word(*table, "colour", names.size() > 1 && !study.random ? names[1] : "");
  if (!study.figure_colour.empty() && !among(study.figure_colour, names))
    file.reject(*table->get("colour"), "'colour' = ", study.figure_colour,
                ": no [[vary]] has this key; there are: ", joined(names));
}

// Uniform in (0, 1), of seed, variant, key and attempt alone. Not std::uniform_real_distribution, which is the library's.
double uniform_draw(int seed, long index, const std::string& key, int attempt) {
  std::uint64_t name = 1469598103934665603u;  // FNV-1a
  for (const unsigned char c : key) name = (name ^ c) * 1099511628211u;
  std::seed_seq sequence{std::uint64_t(seed), std::uint64_t(index), name & 0xffffffffu, name >> 32,
                         std::uint64_t(attempt)};
  std::mt19937 engine(sequence);
  const std::uint64_t high = engine() >> 5, low = engine() >> 6;
  return (static_cast<double>(high << 26 | low) + 0.5) * 0x1p-53;
}

std::string drawn_value(const StudyPlan& study, const VariedKey& key, long index) {
  constexpr int kDigits = 6;
  if (!key.values.empty()) {
    const auto count = key.values.size();
    return key.values[std::min(
        count - 1, static_cast<size_t>(uniform_draw(study.seed, index, key.name, 0) * double(count)))];
  }
  if (!key.normal) {
    const double u = uniform_draw(study.seed, index, key.name, 0);
    if (key.whole)
      return rounded_text(std::min(std::floor(key.first + u * (key.second - key.first + 1)), key.second), 0,
                          true);
    return rounded_text(key.first + u * (key.second - key.first), kDigits, false);
  }
  for (int attempt = 0; attempt < 10000; attempt += 2) {
    const double radius = std::sqrt(-2 * std::log(uniform_draw(study.seed, index, key.name, attempt))),
                 angle = 2 * std::numbers::pi * uniform_draw(study.seed, index, key.name, attempt + 1);
    const std::string value =
        rounded_text(key.first + key.second * radius * std::cos(angle), kDigits, key.whole);
    const double number = std::strtod(value.c_str(), nullptr);
    if (number >= key.least && number <= key.most) return value;
  }
  fail(Failure::input, "no draw of ", key.name, " falls between its 'least' and 'most'");
}

// [[vary]]: the keys that vary, each once, none of them in [set].
void read_varied_keys(const StudyFile& file, Study& study) {
  const toml::node* vary = file.root().get("vary");
  if (!vary) file.reject("the study varies nothing: it lacks [[vary]] with a key and its values");
  const toml::array* list = vary->as_array();
  if (!list || !list->is_array_of_tables() || list->empty())
    file.reject(*vary, "'vary' must be a list of sections: write [[vary]] before each key");
  if (list->size() > kMostKeys) file.reject(*vary, list->size(), " keys vary; ", kMostKeys, " is the most");
  std::vector<KeyPlace> varied, fixed;
  for (const auto& [name, value] : study.fixed) fixed.push_back(find_key(name));
  for (const toml::node& item : *list) {
    const VariedKey key = read_varied(file, *item.as_table(), study.random);
    const KeyPlace place = find_key(key.name);
    for (size_t k = 0; k < varied.size(); ++k)
      if (overlap(place, varied[k]))
        file.reject_line(key.line, "'", key.name, "' varies twice, as '", study.keys[k].name, "' in line ",
                         study.keys[k].line);
    // A torque of [set] is the one that sets the bearing dampers.
    for (const KeyPlace& other : fixed)
      if (overlap(place, other) && !is_torque(*place.key))
        file.reject_line(key.line, "'", key.name, "' varies and is in [set]; leave one of them out");
    varied.push_back(place);
    study.keys.push_back(key);
  }
}

// How many variants the plan has: of a sample as it says, of a grid the product of its keys' values.
void count_variants(const StudyFile& file, Study& study) {
  const toml::table& root = file.root();
  const toml::node* vary = root.get("vary");
  if (study.random) {
    if (!root.contains("samples")) file.reject("a sample lacks samples = <number of variants>");
    study.variants = file.whole(root, "samples", 1, kMostVariants);
  } else {
    double variants = 1;
    for (const VariedKey& key : study.keys) variants *= static_cast<double>(key.values.size());
    if (variants > static_cast<double>(kMostVariants))
      file.reject(*vary, "the grid has ", variants, " variants; ", kMostVariants,
                  " is the most: give fewer values, or draw from them with plan = \"sample\"");
    study.variants = std::lround(variants);
  }
  if (study.variants == 1 && !study.random)
    file.reject(*vary, "the study varies nothing: every key has one value only");
}

}  // namespace

VariedKey varied_key(const std::string& name) {
  const Key& key = *find_key(name).key;
  const Slot& slot = key.slot;
  VariedKey out;
  out.name = name;
  out.whole = std::holds_alternative<int*>(slot);
  out.number = out.whole || std::holds_alternative<double*>(slot) || is_torque(key);
  out.units = out.number ? key.unit.si : "1";
  out.meaning = key.meaning;
  const std::string suffix(key.unit.suffix), owner = find_key(name).owner;
  out.scene_units = suffix.empty() ? "1" : key.unit.in_words();
  out.label = key.name;
  out.label.resize(out.label.size() - suffix.size());
  std::replace(out.label.begin(), out.label.end(), '_', ' ');
  if (!owner.empty()) out.label = owner + ", " + out.label;
  out.to_si_multiply = key.unit.multiply;
  out.to_si_divide = key.unit.divide;
  return out;
}

double VariedKey::si(const std::string& value) const {
  return std::strtod(value.c_str(), nullptr) * to_si_multiply / to_si_divide;
}

Study read_study(const std::string& path) {
  const StudyFile file(path);
  const toml::table& root = file.root();
  file.require_known(root, "",
                     {"title", "scene", "stage", "directions", "plan", "samples", "seed", "quantities",
                      "outside_model", "compare", "set", "vary", "figure"});
  Study study;
  study.path = path;
  study.title = file.word(root, "title", std::filesystem::path(path).stem().string());
  const std::string scene = file.word(root, "scene");
  if (scene.empty())
    file.reject("the study lacks scene = \"../scenes/<name>.toml\", a path from its own folder");
  study.scene = (std::filesystem::path(path).parent_path() / scene).lexically_normal().string();
  const std::string stage = file.choice(root, "stage", "static", {"static", "sweep"});
  if (stage == "static" && root.contains("directions"))
    file.reject(*root.get("directions"),
                "'directions' are those of sweeps: say stage = \"sweep\" or leave them out");
  if (stage == "sweep")
    study.directions =
        choices_in<Direction>(
            joined(file.words(root, "directions", {"up", "down"}, {"up", "down"}, "direction"), " "))
            .value();
  study.random = file.choice(root, "plan", "grid", {"grid", "sample"}) == "sample";
  for (const char* key : {"samples", "seed"})
    if (!study.random && root.contains(key))
      file.reject(*root.get(key), "'", key, "' is of a sample: say plan = \"sample\" or leave it out");
  if (root.contains("seed")) study.seed = static_cast<int>(file.whole(root, "seed", 0, 2147483647));
  study.marks_outside = file.choice(root, "outside_model", "stop", {"stop", "mark"}) == "mark";

  if (const toml::node* fixed = root.get("set")) {
    if (!fixed->is_table()) file.reject(*fixed, "'set' must be a section: write [set]");
    read_fixed(file, *fixed->as_table(), "", study);
  }
  read_varied_keys(file, study);
  count_variants(file, study);
  if (is_system_scene(study.scene)) study.train = names_in_train(file, study);
  for (size_t k = 0; k < study.keys.size() && !study.train.empty(); ++k)
    if (is_torque(*find_key(study.keys[k].name).key))
      file.reject_line(
          study.keys[k].line, "'", study.keys[k].name,
          "' is of pairs: the torques of a train are those of [[drive]]; write key = \"drive.<gear>.torque_Nm\"");
  Words known;
  for (const ResponseQuantity& kind : response_quantities(study.directions, study.train))
    known.push_back(kind.name);
  study.quantities = file.words(root, "quantities", known, known, "response quantity of this stage");
  read_figure(file, study);
  if (const toml::node* marked = root.get("compare")) read_compared(file, *marked, study);
  return study;
}

std::vector<std::string> variant_values(const Study& study, long index) {
  Words out;
  if (study.random) {
    for (const VariedKey& key : study.keys) out.push_back(drawn_value(study, key, index));
    return out;
  }
  // The last key runs fastest.
  long rest = index;
  for (size_t k = study.keys.size(); k-- > 0;) {
    const auto count = static_cast<long>(study.keys[k].values.size());
    out.insert(out.begin(), study.keys[k].values[static_cast<size_t>(rest % count)]);
    rest /= count;
  }
  return out;
}

StudyVariant study_variant(const Study& study, long index, const std::vector<std::string>& values) {
  Words changes;
  double torque = 0;
  for (const auto& [name, value] : study.fixed) changes.push_back(name + "=" + value);
  for (size_t k = 0; k < values.size(); ++k) {
    const Key& key = *find_key(study.keys[k].name).key;
    if (!is_torque(key)) {
      changes.push_back(study.keys[k].name + "=" + values[k]);
      continue;
    }
    torque = std::strtod(values[k].c_str(), nullptr);
    if (!(torque > key.limits.least && torque <= key.limits.most))
      fail(Failure::input, study.path, ":", study.keys[k].line, ": ", variant_name(study, index, values),
           ": the torque must be greater than ", key.limits.least, ", at most ", key.limits.most, " N m");
  }
  try {
    const std::string variant = scene_variant(study.scene, changes);
    Scene scene = read_variant_of(study.scene, variant);
    if (scene.pair() && torque == 0) torque = scene.operation.torques.front();
    System layout = scene.pair() ? System() : layout_of(scene);
    return {std::move(scene), torque, std::move(layout)};
  } catch (const Error& error) {
    // The line of the key that the error is about, if it varies.
    std::string line;
    const auto* about = dynamic_cast<const KeyError*>(&error);
    for (const VariedKey& key : study.keys)
      if (about && about->key() == key.name.substr(key.name.rfind('.') + 1)) line = text(":", key.line);
    fail(error.kind() == Failure::io ? Failure::io : Failure::input, study.path, line, ": ",
         variant_name(study, index, values), ": ", error.what());
  }
}

}  // namespace whine
