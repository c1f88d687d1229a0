// /parameters of artifacts: what the keys of a scene hold, a number or a word each.
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "io/artifact.h"
#include "io/keys.h"

namespace whine {
namespace {

constexpr const char* kLargestAngle = "_largest_angle";

// What /parameters holds of a key: of a corner rule two numbers, the second left out where it is infinite.
struct Part {
  std::string name;
  const char *units, *meaning;
  Slot slot;
};
std::vector<Part> parts_of(const Key& key) {
  const std::string name = key.si_name();
  if (const auto* corner = std::get_if<CornerRule*>(&key.slot))
    return {{name, "1", "1: a tip edge may touch a flank off the line of action", &(*corner)->enabled},
            {name + kLargestAngle, key.unit.si, "largest angle between the two normals",
             &(*corner)->largest_angle}};
  return {{name, key.unit.si, key.meaning, key.slot}};
}

// A limit of a key, to the rounding of its unit, as a limit in SI.
Range si_range(const Key& key) {
  constexpr double kRoundOff = 1e-9;
  if (!(key.limits.most > key.limits.least)) return {};
  // body = "full" takes every mode; a body that only statics use may have none.
  const double least = key.called("modes")  ? kAllModes
                       : key.limits.or_zero ? 0
                                            : key.to_si(key.limits.least),
               most = key.to_si(key.limits.most);
  return {least - kRoundOff * std::abs(least), most + kRoundOff * std::abs(most), key.limits.open};
}

// Of a list that is kept as text.
std::vector<double> numbers_in(const std::string& word) {
  std::vector<double> numbers;
  for (const char* at = word.c_str(); *at;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end != at) numbers.push_back(number);
    at = end != at ? end : at + 1;
  }
  return numbers;
}

void take(const ArtifactReader& in, const std::string& section, const Key& key) {
  const Range range = si_range(key);
  for (const Part& part : parts_of(key)) {
    const std::string name = section + part.name;
    const auto checked = [&](auto number) {
      if (const std::string why = outside(range, number); !why.empty())
        in.reject(text("dataset ", name, " ", why));
      return number;
    };
    const auto numbers = [&] { return in.has(name) ? numbers_in(in.word(name)) : std::vector<double>(); };
    std::visit(
        Overloaded{[&](double* held) {
                     *held = name.ends_with(kLargestAngle) && !in.has(name)
                                 ? std::numeric_limits<double>::infinity()
                                 : checked(in.number(name));
                   },
                   [&](int* held) { *held = checked(in.whole(name)); },
                   [&](bool* held) { *held = in.whole(name) != 0; },
                   [&](std::string* held) { *held = in.word(name); },
                   [&](const ChoiceSlot& choice) {
                     const std::string word = in.word(name);
                     if (!place_of(key.choices, word))
                       in.reject(text("dataset ", name, " is '", word, "', which is none of: ", key.choices));
                     key.assign(choice, word);
                   },
                   [&](std::vector<double>* list) {
                     *list = numbers();
                     for (const double item : *list) checked(item);
                   },
                   [&](Points* points) {
                     points->clear();
                     const std::vector<double> all = numbers();
                     for (std::size_t i = 0; i + 1 < all.size(); i += 2)
                       points->push_back({all[i], all[i + 1]});
                   },
                   [](const auto&) {}},
        part.slot);
  }
}

// Section of /parameters that holds a key of a list in `section`.
std::string held_in(const Key& key, const std::string& section) {
  if (key.own.empty()) return section;
  return key.own[0] == '_' ? section + key.own : key.own;
}

}  // namespace

std::vector<Parameter> parameters_of(const Key& key) {
  std::vector<Parameter> out;
  for (const Part& part : parts_of(key)) {
    Key own = key;
    own.slot = part.slot;
    const auto add = [&](const auto& value) { out.push_back({part.name, part.units, part.meaning, value}); };
    const auto add_list = [&](const auto& list) {
      if (!list.empty()) add(exact_value(own, ""));
    };
    std::visit(Overloaded{[&](bool on) { add(on ? 1 : 0); }, [&](int whole) { add(whole); },
                          [&](double number) {
                            if (!std::isinf(number)) add(number);
                          },
                          [&](const std::string& word) { add(word); },
                          [&](const std::vector<double>& list) { add_list(list); },
                          [&](const Points& points) { add_list(points); }},
               own.value());
  }
  return out;
}

void ArtifactWriter::parameters(const std::string& section, const KeyList& keys) {
  for (const Key& key : keys)
    for (const Parameter& part : is_held(key) ? parameters_of(key) : std::vector<Parameter>())
      std::visit(
          [&](const auto& value) {
            put("/parameters/" + held_in(key, section) + "/" + part.name, value,
                {part.units, part.meaning, "", ""});
          },
          part.value);
}

void ArtifactReader::parameters(const std::string& section, const KeyList& keys) const {
  const auto place = [&](const Key& key) { return "/parameters/" + held_in(key, section) + "/"; };
  read_held(
      keys, [&](const Key& key) { return has(place(key) + key.si_name()); }, place,
      [&](const std::string& own, const KeyList& held) {
        for (const Key& key : held) take(*this, own, key);
      });
}

}  // namespace whine
