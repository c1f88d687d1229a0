#include "io/rexs/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/tool.h"
#include "io/rexs/results.h"

namespace whine {
namespace {

constexpr std::string_view kBlanks = " \t\n\r";
constexpr const char* kOfLoad = "load case, ";

constexpr RexsUnit kUnits[] = {
    {"", RexsDimension::number, 1},         {"none", RexsDimension::number, 1},
    {"-", RexsDimension::number, 1},        {"mum", RexsDimension::length, 1e-6},
    {"µm", RexsDimension::length, 1e-6},    {"mm", RexsDimension::length, 1e-3},
    {"m", RexsDimension::length, 1},        {"deg", RexsDimension::angle, kPi / 180},
    {"°", RexsDimension::angle, kPi / 180}, {"rad", RexsDimension::angle, 1},
    {"Pa", RexsDimension::pressure, 1},     {"N/mm^2", RexsDimension::pressure, 1e6},
    {"MPa", RexsDimension::pressure, 1e6},  {"GPa", RexsDimension::pressure, 1e9},
    {"kg/m^3", RexsDimension::density, 1},  {"kg/dm^3", RexsDimension::density, 1e3},
    {"Nmm", RexsDimension::moment, 1e-3},   {"Nm", RexsDimension::moment, 1},
    {"kNm", RexsDimension::moment, 1e3},    {"1/min", RexsDimension::frequency, 1.0 / 60},
    {"1/s", RexsDimension::frequency, 1},   {"W", RexsDimension::power, 1},
    {"kW", RexsDimension::power, 1e3},      {"MW", RexsDimension::power, 1e6}};

// In another unit, without the digits that only round-off has.
double converted(double value, const RexsUnit& from, const RexsUnit& to) {
  if (from.si == to.si) return value;
  return with_digits(value * from.si / to.si, 15);
}

std::string without_blanks(std::string word) {
  std::erase_if(word, [](char x) { return kBlanks.find(x) != std::string_view::npos; });
  return word;
}

}  // namespace

double with_digits(double value, int digits) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  std::from_chars(buffer, end, value);
  return value;
}

// Texts of the file: control characters would end a comment.
std::string quoted_name(const RexsComponent& c) {
  return text(printable(c.type, 80), " ", c.id, c.name.empty() ? "" : " '" + printable(c.name, 80) + "'");
}

RexsReader::RexsReader(const RexsModel& model, int load_case) : model_(model) {
  if (load_case < 1 ||
      (!model.load_cases.empty() && static_cast<size_t>(load_case) > model.load_cases.size()))
    fail(Failure::input, model.path, ": there is no load case ", load_case, ", there are ",
         model.load_cases.size());
  if (!model.load_cases.empty()) load_ = &model.load_cases[static_cast<size_t>(load_case) - 1];
}

const RexsComponent* RexsReader::beside(int id, const std::string& type) const {
  const auto all = related(id);
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto* c) { return c->type == type; });
  return found == all.end() ? nullptr : *found;
}

std::vector<const RexsComponent*> RexsReader::related(int id) const {
  std::vector<const RexsComponent*> out;
  for (const RexsRelation& relation : model_.relations)
    if (relation.holds(id))
      for (const RexsRelation::Reference& other : relation.references)
        if (other.component != id) out.push_back(&component(other.component));
  return out;
}

const RexsComponent* RexsReader::flank(int gear, const std::string& role) const {
  for (const RexsRelation& relation : model_.relations)
    if (relation.type == "flank" && relation.in_role("gear") == gear && relation.in_role(role) >= 0)
      return &component(relation.in_role(role));
  return nullptr;
}

const RexsComponent* RexsReader::stage_gear_data(int stage, int gear) const {
  for (const RexsRelation& relation : model_.relations)
    if (relation.type == "stage_gear_data" && relation.in_role("stage") == stage &&
        relation.in_role("gear") == gear && relation.in_role("stage_gear_data") >= 0)
      return &component(relation.in_role("stage_gear_data"));
  return nullptr;
}

// nullptr: none
const RexsAttribute* RexsReader::attribute_of(const RexsComponent& c, const std::string& name,
                                              bool of_load) const {
  if (of_load && !(load_ && load_->contains(c.id))) return nullptr;
  const auto& attributes = of_load ? load_->at(c.id).attributes : c.attributes;
  const auto found = attributes.find(name);
  return found == attributes.end() ? nullptr : &found->second;
}

RexsReader::Found RexsReader::found(const RexsComponent* c, const std::string& attribute) {
  if (!c) return {};
  const RexsAttribute *of_load = attribute_of(*c, attribute, true),
                      *a = of_load ? of_load : attribute_of(*c, attribute, false);
  if (a) read_[c->id].insert(attribute);
  return {a, (of_load ? kOfLoad : "") + quoted_name(*c) + ", " + attribute};
}

double RexsReader::value_of(const RexsComponent& c, const std::string& attribute, const std::string& given,
                            const std::string& of_unit, const RexsUnit& unit) const {
  const std::string word = without_blanks(given), own_unit = without_blanks(of_unit);
  const auto reject = [&](const std::string& why) {
    fail(Failure::input, model_.path, ": '", attribute, "' of ", quoted_name(c), " ", why);
  };
  if (word.empty()) reject("is no single number");
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    reject(text("= '", printable(word, 40), "' is no number"));
  const RexsUnit* known = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const RexsUnit& u) {
    return own_unit == u.word && u.dimension == unit.dimension;
  });
  if (known == std::end(kUnits))
    reject(text("is in '", printable(own_unit, 40), "', which is no unit of it"));
  return converted(value, *known, unit);
}

std::optional<RexsNumber> RexsReader::number(const RexsComponent* c, const std::string& attribute,
                                             const RexsUnit& unit) {
  const Found at = found(c, attribute);
  if (!at.attribute) return {};
  return RexsNumber{
      value_of(*c, attribute, at.attribute->list ? "" : at.attribute->value, at.attribute->unit, unit),
      at.origin};
}

std::optional<std::array<double, 3>> RexsReader::vector(const RexsComponent* c, const std::string& attribute,
                                                        const RexsUnit& unit) {
  const Found at = found(c, attribute);
  if (!at.attribute || at.attribute->values.size() != 3) return {};
  std::array<double, 3> out{};
  for (size_t i = 0; i < 3; ++i)
    out[i] = value_of(*c, attribute, at.attribute->values[i], at.attribute->unit, unit);
  return out;
}

RexsNumber RexsReader::required(const RexsComponent& c, const std::string& attribute, const RexsUnit& unit) {
  const std::optional<RexsNumber> found = number(&c, attribute, unit);
  if (!found)
    fail(Failure::input, model_.path, ": ", quoted_name(c), " has no '", attribute,
         "', which a scene cannot do without; add it to the model");
  return *found;
}

std::string RexsReader::word(const RexsComponent* c, const std::string& attribute) {
  const RexsAttribute* a = found(c, attribute).attribute;
  if (!a) return "";
  const auto first = a->value.find_first_not_of(kBlanks), last = a->value.find_last_not_of(kBlanks);
  return first == std::string::npos ? "" : a->value.substr(first, last - first + 1);
}

std::vector<std::string> RexsReader::words(const RexsComponent* c, const std::string& attribute) {
  const RexsAttribute* a = found(c, attribute).attribute;
  if (!a) return {};
  return a->list ? a->values : std::vector<std::string>{word(c, attribute)};
}

std::optional<bool> RexsReader::flag(const RexsComponent* c, const std::string& attribute) {
  const std::string said = word(c, attribute);
  if (said == "true" || said == "1") return true;
  if (said == "false" || said == "0") return false;
  if (!said.empty())
    fail(Failure::input, model_.path, ": '", attribute, "' of ", quoted_name(*c), " = '", printable(said, 40),
         "' is neither true nor false");
  return {};
}

std::vector<std::string> RexsReader::unread() const {
  std::vector<std::string> out;
  for (const auto& [id, attributes] : read_) {
    const auto list = [&, &names_read = attributes, &owner = component(id)](const RexsComponent& c,
                                                                            const std::string& where) {
      std::string names;
      for (const auto& [name, value] : c.attributes)
        if (!names_read.contains(name) && !name.starts_with(kRexsResult))
          names += (names.empty() ? "" : ", ") + printable(name, 80);
      if (!names.empty()) out.push_back(where + quoted_name(owner) + ": " + names);
    };
    list(component(id), "");
    if (load_ && load_->contains(id)) list(load_->at(id), kOfLoad);
  }
  return out;
}

std::optional<RexsNumber> RexsReader::of_flanks(int gear, const std::string& attribute,
                                                const RexsUnit& unit) {
  const std::optional<RexsNumber> left = number(flank(gear, "left"), attribute, unit),
                                  right = number(flank(gear, "right"), attribute, unit);
  if (left && right && std::abs(left->value - right->value) > 1e-9)
    fail(Failure::input, path(), ": the flanks of ", quoted_name(component(gear)), " differ: ", attribute,
         " = ", left->value, " and ", right->value, "; a scene has symmetric teeth");
  return left ? left : right;
}

}  // namespace whine
