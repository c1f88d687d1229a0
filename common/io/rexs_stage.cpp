#include "io/rexs_stage.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/tool.h"
#include "base/units.h"
#include "io/rexs_results.h"

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
    {"1/s", RexsDimension::frequency, 1}};

// In another unit, without the digits that only round-off has.
double converted(double value, const RexsUnit& from, const RexsUnit& to) {
  if (from.si == to.si) return value;
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value * from.si / to.si, std::chars_format::general, 15)
          .ptr;
  std::from_chars(buffer, end, value);
  return value;
}

}  // namespace

// Texts of the file: control characters would end a comment.
std::string quoted_name(const RexsComponent& c) {
  return text(printable(c.type, 80), " ", c.id, c.name.empty() ? "" : " '" + printable(c.name, 80) + "'");
}

RexsStage::RexsStage(const RexsModel& model, const std::string& wanted, int load_case) : model_(model) {
  if (load_case < 1 ||
      (!model.load_cases.empty() && static_cast<size_t>(load_case) > model.load_cases.size()))
    fail(Failure::input, model.path, ": there is no load case ", load_case, ", there are ",
         model.load_cases.size());
  if (!model.load_cases.empty()) load_ = &model.load_cases[static_cast<size_t>(load_case) - 1];
  id_ = choose(wanted);
  for (const RexsRelation& relation : model.relations) {
    if (relation.type != "stage" || relation.in_role("stage") != id_) continue;
    gear_ = {relation.in_role("gear_1"), relation.in_role("gear_2")};
  }
  for (const int gear : gear_)
    if (gear < 0)
      fail(Failure::input, model.path, ": ", quoted_name(stage()),
           " has no relation 'stage' with gear_1 and gear_2");
  put_driver_first();
}

const RexsComponent* RexsStage::beside(int id, const std::string& type) const {
  const auto all = related(id);
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto* c) { return c->type == type; });
  return found == all.end() ? nullptr : *found;
}

std::vector<const RexsComponent*> RexsStage::related(int id) const {
  std::vector<const RexsComponent*> out;
  for (const RexsRelation& relation : model_.relations)
    if (relation.holds(id))
      for (const RexsRelation::Reference& other : relation.references)
        if (other.component != id) out.push_back(&component(other.component));
  return out;
}

const RexsComponent* RexsStage::flank(int side, const std::string& role) const {
  for (const RexsRelation& relation : model_.relations)
    if (relation.type == "flank" && relation.in_role("gear") == gear(side).id && relation.in_role(role) >= 0)
      return &component(relation.in_role(role));
  return nullptr;
}

const RexsComponent* RexsStage::stage_gear_data(int side) const {
  for (const RexsRelation& relation : model_.relations)
    if (relation.type == "stage_gear_data" && relation.in_role("stage") == id_ &&
        relation.in_role("gear") == gear(side).id && relation.in_role("stage_gear_data") >= 0)
      return &component(relation.in_role("stage_gear_data"));
  return nullptr;
}

// nullptr: none
const RexsAttribute* RexsStage::attribute_of(const RexsComponent& c, const std::string& name,
                                             bool of_load) const {
  if (of_load && !(load_ && load_->contains(c.id))) return nullptr;
  const auto& attributes = of_load ? load_->at(c.id).attributes : c.attributes;
  const auto found = attributes.find(name);
  return found == attributes.end() ? nullptr : &found->second;
}

std::optional<RexsNumber> RexsStage::number(const RexsComponent* c, const std::string& attribute,
                                            const RexsUnit& unit) {
  if (!c) return {};
  const RexsAttribute *of_load = attribute_of(*c, attribute, true),
                      *a = of_load ? of_load : attribute_of(*c, attribute, false);
  if (!a) return {};
  std::string word = a->value, given = a->unit;
  const auto blank = [](char x) { return kBlanks.find(x) != std::string_view::npos; };
  std::erase_if(word, blank);
  std::erase_if(given, blank);
  const auto reject = [&](const std::string& why) {
    fail(Failure::input, model_.path, ": '", attribute, "' of ", quoted_name(*c), " ", why);
  };
  if (a->list || word.empty()) reject("is no single number");
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    reject(text("= '", printable(word, 40), "' is no number"));
  const RexsUnit* known = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const RexsUnit& u) {
    return given == u.word && u.dimension == unit.dimension;
  });
  if (known == std::end(kUnits)) reject(text("is in '", printable(given, 40), "', which is no unit of it"));
  read_[c->id].insert(attribute);
  return RexsNumber{converted(value, *known, unit),
                    (of_load ? kOfLoad : "") + quoted_name(*c) + ", " + attribute};
}

RexsNumber RexsStage::required(const RexsComponent* c, const RexsComponent& owner,
                               const std::string& attribute, const RexsUnit& unit) {
  const std::optional<RexsNumber> found = number(c, attribute, unit);
  if (!found)
    fail(Failure::input, model_.path, ": ", quoted_name(c ? *c : owner), " has no '", attribute,
         "', which a scene cannot do without; add it to the model");
  return *found;
}

std::string RexsStage::word(const RexsComponent* c, const std::string& attribute) {
  if (!c) return "";
  const RexsAttribute* a = attribute_of(*c, attribute, true);
  if (!a) a = attribute_of(*c, attribute, false);
  if (!a) return "";
  read_[c->id].insert(attribute);
  const auto first = a->value.find_first_not_of(kBlanks), last = a->value.find_last_not_of(kBlanks);
  return first == std::string::npos ? "" : a->value.substr(first, last - first + 1);
}

std::optional<bool> RexsStage::flag(const RexsComponent* c, const std::string& attribute) {
  const std::string said = word(c, attribute);
  if (said == "true" || said == "1") return true;
  if (said == "false" || said == "0") return false;
  if (!said.empty())
    fail(Failure::input, model_.path, ": '", attribute, "' of ", quoted_name(*c), " = '", printable(said, 40),
         "' is neither true nor false");
  return {};
}

std::vector<std::string> RexsStage::unread() const {
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

int RexsStage::choose(const std::string& wanted) const {
  std::vector<const RexsComponent*> found, all;
  for (const auto& [id, c] : model_.components) {
    if (c.type != "cylindrical_stage") continue;
    all.push_back(&c);
    if (wanted.empty() || wanted == std::to_string(id) || wanted == c.name) found.push_back(&c);
  }
  if (found.size() == 1) return found[0]->id;
  std::string list;
  for (const RexsComponent* c : all) list += (list.empty() ? "" : "; ") + quoted_name(*c);
  if (all.empty()) fail(Failure::input, model_.path, ": holds no cylindrical_stage");
  if (wanted.empty())
    fail(Failure::input, model_.path, ": holds ", all.size(), " stages; name one with --stage: ", list);
  fail(Failure::input, model_.path, ": ", found.empty() ? "no stage" : "more than one stage", " is called '",
       printable(wanted, 80), "'; there are ", list);
}

// Signs of torque and speed do not tell: they follow the axes of the shafts, which are not read.
void RexsStage::put_driver_first() {
  const auto one = flag(stage_gear_data(0), "is_driving_gear"),
             two = flag(stage_gear_data(1), "is_driving_gear");
  if (one == true && two == true)
    fail(Failure::input, model_.path, ": is_driving_gear is true of both gears of ", quoted_name(stage()),
         "; a stage has one driver");
  // A gear that is said not to drive leaves the other.
  const bool first = one == true || (!one && two == false), second = two == true || (!two && one == false);
  if (second) std::swap(gear_[0], gear_[1]);
  if (first || second) return;
  driver_assumed_ = one ? "gear_1 of the stage: is_driving_gear is false of both gears"
                        : "gear_1 of the stage: the model has no is_driving_gear";
}

RexsNumber RexsStage::of_flanks(int side, const std::string& attribute, const RexsUnit& unit) {
  const RexsComponent *left = flank(side, "left"), *right = flank(side, "right");
  const RexsNumber one = required(left ? left : right, gear(side), attribute, unit);
  const std::optional<RexsNumber> other = number(right, attribute, unit);
  if (other && std::abs(other->value - one.value) > 1e-9)
    fail(Failure::input, path(), ": the flanks of ", quoted_name(gear(side)), " differ: ", attribute, " = ",
         one.value, " and ", other->value, "; a scene has symmetric teeth");
  return one;
}

}  // namespace whine
