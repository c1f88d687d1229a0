#include "io/rexs_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/tool.h"

namespace whine {
namespace {

constexpr double kPi = std::numbers::pi;

enum class Dimension { number, length, angle, pressure, density, moment, frequency };
struct Unit {
  const char* word;  // without blanks
  Dimension dimension;
  double si;
};
constexpr Unit kUnits[] = {{"", Dimension::number, 1},         {"none", Dimension::number, 1},
                           {"-", Dimension::number, 1},        {"mum", Dimension::length, 1e-6},
                           {"µm", Dimension::length, 1e-6},    {"mm", Dimension::length, 1e-3},
                           {"m", Dimension::length, 1},        {"deg", Dimension::angle, kPi / 180},
                           {"°", Dimension::angle, kPi / 180}, {"rad", Dimension::angle, 1},
                           {"Pa", Dimension::pressure, 1},     {"N/mm^2", Dimension::pressure, 1e6},
                           {"MPa", Dimension::pressure, 1e6},  {"GPa", Dimension::pressure, 1e9},
                           {"kg/m^3", Dimension::density, 1},  {"kg/dm^3", Dimension::density, 1e3},
                           {"Nmm", Dimension::moment, 1e-3},   {"Nm", Dimension::moment, 1},
                           {"kNm", Dimension::moment, 1e3},    {"1/min", Dimension::frequency, 1.0 / 60},
                           {"1/s", Dimension::frequency, 1}};
// What keys of a scene are in.
constexpr Unit kNumber{"", Dimension::number, 1}, kMicrometre{"mum", Dimension::length, 1e-6},
    kMillimetre{"mm", Dimension::length, 1e-3}, kDegree{"deg", Dimension::angle, kPi / 180},
    kGigapascal{"GPa", Dimension::pressure, 1e9}, kDensity{"kg/m^3", Dimension::density, 1},
    kNewtonMetre{"Nm", Dimension::moment, 1}, kPerMinute{"1/min", Dimension::frequency, 1.0 / 60};

// All digits, and no more.
std::string digits(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  const std::string word(buffer, end);
  return word.find_first_of(".en") == std::string::npos ? word + ".0" : word;
}

// In another unit, without the digits that only round-off has.
double converted(double value, const Unit& from, const Unit& to) {
  if (from.si == to.si) return value;
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value * from.si / to.si, std::chars_format::general, 15)
          .ptr;
  std::from_chars(buffer, end, value);
  return value;
}

// A text of the file in a comment of TOML, which control characters would end.
std::string quoted_name(const RexsComponent& c) {
  return text(c.type, " ", c.id, c.name.empty() ? "" : " '" + printable(c.name, 80) + "'");
}

struct Number {
  double value;        // in the unit that was asked for
  std::string origin;  // component and attribute
};

// The stage that is imported; notes which attributes were read.
class Stage {
 public:
  Stage(const RexsModel& model, const std::string& wanted, int load_case) : model_(model) {
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
    // The driver first.
    if (flag(stage_gear_data(1), "is_driving_gear") && !flag(stage_gear_data(0), "is_driving_gear"))
      std::swap(gear_[0], gear_[1]);
  }

  const RexsComponent& component(int id) const { return model_.components.at(id); }
  const RexsComponent& stage() const { return component(id_); }
  const RexsComponent& gear(int side) const { return component(gear_[static_cast<size_t>(side)]); }

  // The first component of a type that stands in a relation with `id`; nullptr: none.
  const RexsComponent* beside(int id, const std::string& type) const {
    for (const RexsRelation& relation : model_.relations)
      if (relation.holds(id))
        for (const RexsRelation::Reference& other : relation.references)
          if (other.component != id && component(other.component).type == type)
            return &component(other.component);
    return nullptr;
  }
  const RexsComponent* flank(int side, const std::string& role) const {
    for (const RexsRelation& relation : model_.relations)
      if (relation.type == "flank" && relation.in_role("gear") == gear(side).id &&
          relation.in_role(role) >= 0)
        return &component(relation.in_role(role));
    return nullptr;
  }
  const RexsComponent* stage_gear_data(int side) const {
    for (const RexsRelation& relation : model_.relations)
      if (relation.type == "stage_gear_data" && relation.in_role("stage") == id_ &&
          relation.in_role("gear") == gear(side).id && relation.in_role("stage_gear_data") >= 0)
        return &component(relation.in_role("stage_gear_data"));
    return nullptr;
  }
  // Components of a type in any relation with `id`, and those of other types.
  std::vector<const RexsComponent*> related(int id) const {
    std::vector<const RexsComponent*> out;
    for (const RexsRelation& relation : model_.relations)
      if (relation.holds(id))
        for (const RexsRelation::Reference& other : relation.references)
          if (other.component != id) out.push_back(&component(other.component));
    return out;
  }

  std::optional<Number> number(const RexsComponent* c, const std::string& attribute, const Unit& unit) {
    if (!c) return {};
    if (load_ && load_->contains(c->id)) {
      const auto of_load = number_in(load_->at(c->id), attribute, unit, "load case, ");
      if (of_load) return of_load;
    }
    return number_in(*c, attribute, unit, "");
  }
  Number required(const RexsComponent* c, const RexsComponent& owner, const std::string& attribute,
                  const Unit& unit) {
    const std::optional<Number> found = number(c, attribute, unit);
    if (!found)
      fail(Failure::input, model_.path, ": ", quoted_name(c ? *c : owner), " has no '", attribute,
           "', which a scene cannot do without; add it to the model");
    return *found;
  }
  std::string word(const RexsComponent* c, const std::string& attribute) {
    if (!c || !c->attributes.contains(attribute)) return "";
    read_[c->id].insert(attribute);
    return c->attributes.at(attribute).value;
  }
  bool flag(const RexsComponent* c, const std::string& attribute) { return word(c, attribute) == "true"; }

  // What was not read of the components that something was read of.
  std::vector<std::string> unread() const {
    std::vector<std::string> out;
    for (const auto& [id, attributes] : read_) {
      std::string names;
      for (const auto& [name, value] : component(id).attributes)
        if (!attributes.contains(name)) names += (names.empty() ? "" : ", ") + printable(name, 80);
      if (!names.empty()) out.push_back(quoted_name(component(id)) + ": " + names);
    }
    return out;
  }
  const std::string& path() const { return model_.path; }

 private:
  int choose(const std::string& wanted) const {
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
    fail(Failure::input, model_.path, ": ", found.empty() ? "no stage" : "more than one stage",
         " is called '", printable(wanted, 80), "'; there are ", list);
  }
  std::optional<Number> number_in(const RexsComponent& c, const std::string& attribute, const Unit& unit,
                                  const std::string& where) {
    const auto found = c.attributes.find(attribute);
    if (found == c.attributes.end()) return {};
    const RexsAttribute& a = found->second;
    std::string word = a.value, given = a.unit;
    const auto blank = [](char x) { return x == ' ' || x == '\t' || x == '\n' || x == '\r'; };
    std::erase_if(word, blank);
    std::erase_if(given, blank);
    const auto reject = [&](const std::string& why) {
      fail(Failure::input, model_.path, ": '", attribute, "' of ", quoted_name(c), " ", why);
    };
    if (a.list || word.empty()) reject("is no single number");
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      reject(text("= '", printable(word, 40), "' is no number"));
    const Unit* known = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& u) {
      return given == u.word && u.dimension == unit.dimension;
    });
    if (known == std::end(kUnits)) reject(text("is in '", printable(given, 40), "', which is no unit of it"));
    read_[c.id].insert(attribute);
    return Number{converted(value, *known, unit), where + quoted_name(component(c.id)) + ", " + attribute};
  }

  const RexsModel& model_;
  const std::map<int, RexsComponent>* load_ = nullptr;
  int id_ = -1;
  std::array<int, 2> gear_ = {-1, -1};
  std::map<int, std::set<std::string>> read_;
};

class Writer {
 public:
  explicit Writer(RexsScene& out) : out_(out) {}
  void line(const std::string& words) { out_.text += words + "\n"; }
  void section(const std::string& name) { line("\n" + name); }
  void value(const std::string& key, const std::string& value, const std::string& remark) {
    std::string start = key + " = " + value;
    start.resize(std::max<size_t>(start.size() + 1, 34), ' ');
    line(start + "# " + remark);
  }
  void value(const std::string& key, const Number& n) { value(key, digits(n.value), n.origin); }
  void whole(const std::string& key, const Number& n) {
    value(key, std::to_string(std::lround(n.value)), n.origin);
  }
  void assumed(const std::string& key, const std::string& of, const std::string& word,
               const std::string& why) {
    value(key, word, "ASSUMED: " + why);
    out_.assumed.push_back(of + key + " = " + word + ": " + why);
  }

 private:
  RexsScene& out_;
};

// Letters, digits and '_' of a component's name, as sections of a scene are called.
std::string section_name(const RexsComponent& c) {
  std::string out;
  for (const char x : c.name) {
    const bool plain = (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9');
    if (plain)
      out += static_cast<char>(x >= 'A' && x <= 'Z' ? x - 'A' + 'a' : x);
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() || out.size() > 40 ? text("gear_", c.id) : out;
}

// As both flanks have it.
Number of_flanks(Stage& stage, int side, const std::string& attribute, const Unit& unit) {
  const RexsComponent *left = stage.flank(side, "left"), *right = stage.flank(side, "right");
  const Number one = stage.required(left ? left : right, stage.gear(side), attribute, unit);
  const std::optional<Number> other = stage.number(right, attribute, unit);
  if (other && std::abs(other->value - one.value) > 1e-9)
    fail(Failure::input, stage.path(), ": the flanks of ", quoted_name(stage.gear(side)),
         " differ: ", attribute, " = ", one.value, " and ", other->value, "; a scene has symmetric teeth");
  return one;
}

void check_spur(Stage& stage, int side) {
  const RexsComponent& gear = stage.gear(side);
  if (gear.type != "cylindrical_gear")
    fail(Failure::input, stage.path(), ": ", quoted_name(gear),
         " is no cylindrical_gear; only external spur gears are imported");
  const std::optional<Number> helix = stage.number(&gear, "helix_angle_reference_diameter", kDegree);
  if (helix && helix->value != 0)
    fail(Failure::input, stage.path(), ": ", quoted_name(stage.stage()), " is helical (", helix->value,
         " degrees at ", quoted_name(gear), "); only spur gears are imported");
  const Number teeth = stage.required(&gear, gear, "number_of_teeth", kNumber);
  if (teeth.value < 0)
    fail(Failure::input, stage.path(), ": ", quoted_name(gear), " is internal (", teeth.value,
         " teeth); only external spur gears are imported");
}

// Heights of the teeth: diameters where they are given, else those of the rack-shaped tool.
void write_heights(Stage& stage, int side, const std::string& of, Writer& out) {
  const RexsComponent& gear = stage.gear(side);
  const RexsComponent* tool = stage.beside(gear.id, "rack_shaped_tool");
  for (const char* role : {"left", "right"})
    if (const RexsComponent* flank = stage.flank(side, role); flank && !tool)
      tool = stage.beside(flank->id, "rack_shaped_tool");
  // The tip of the tool cuts the root of the gear.
  struct Height {
    const char *diameter, *key, *coefficient, *standard;
  };
  for (const Height& h :
       {Height{"tip_diameter", "addendum", "dedendum_coefficient_reference_profile", "1.0"},
        Height{"root_diameter", "dedendum", "addendum_coefficient_reference_profile", "1.25"}}) {
    if (const auto diameter = stage.number(&gear, h.diameter, kMillimetre))
      out.value(std::string(h.diameter) + "_mm", *diameter);
    else if (const auto coefficient = stage.number(tool, h.coefficient, kNumber))
      out.value(h.key, *coefficient);
    else
      out.assumed(h.key, of, h.standard, "ISO 53, profile A");
  }
  std::optional<Number> radius;
  for (const char* name : {"tip_corner_radius_factor_reference_profile", "tip_radius_factor"})
    if (!radius) radius = stage.number(tool, name, kNumber);
  if (radius)
    out.value("rack_tip_radius", *radius);
  else
    out.assumed("rack_tip_radius", of, "0.38", "ISO 53, profile A");
}

// ISO 21771: an arc of 2 m (x - x_E) tan(alpha) is cut off by generating with x_E.
void write_thinning(Stage& stage, int side, const std::string& of, double module_mm, double shift,
                    double angle_deg, Writer& out) {
  const RexsComponent* settings =
      stage.beside(stage.gear(side).id, "cylindrical_gear_manufacturing_settings");
  const auto generated = stage.number(settings, "generated_addendum_modification_coefficient", kNumber);
  if (generated)
    out.value(
        "tooth_thinning_mm",
        {2 * module_mm * (shift - generated->value) * std::tan(angle_deg * kPi / 180), generated->origin});
  else
    out.assumed("tooth_thinning_mm", of, "0.0", "no backlash");
}

// The flank that carries load: as the stage says, else the left one.
const RexsComponent* working_flank(Stage& stage, int side) {
  const std::string loaded = stage.word(stage.stage_gear_data(side), "loaded_tooth_flank");
  const RexsComponent* flank = stage.flank(side, loaded == "right" ? "right" : "left");
  return flank ? flank : stage.flank(side, loaded == "right" ? "left" : "right");
}

void write_modifications(Stage& stage, int side, const std::string& name, Writer& out, RexsScene& scene) {
  const RexsComponent* flank = working_flank(stage, side);
  if (!flank) return;
  bool begun = false;
  for (const RexsComponent* c : stage.related(flank->id)) {
    const bool tip = c->type == "tip_relief", root = c->type == "root_relief";
    const auto skip = [&](const std::string& why) {
      scene.ignored.push_back(quoted_name(*c) + " of " + quoted_name(*flank) + why);
    };
    if (c->type == "cylindrical_gear" || c->type == "rack_shaped_tool") continue;
    const std::string kind = c->type;
    const auto begin = [&] {
      if (!begun) out.section("[gear." + name + ".modification]   # of " + quoted_name(*flank));
      begun = true;
    };
    if (tip || root) {
      const auto depth = stage.number(c, kind + "_depth", kMicrometre);
      const auto datum = stage.number(c, kind + "_datum_diameter", kMillimetre);
      if (!depth || !datum) {
        skip(": a relief needs " + kind + "_depth and " + kind + "_datum_diameter");
        continue;
      }
      begin();
      out.value(kind + "_um", *depth);
      out.value(kind + "_start_radius_mm", {datum->value / 2, datum->origin});
      const std::string shape = stage.word(c, "shape_of_relief");
      if (shape == "linear" || shape == "parabolic")
        out.value(kind + "_shape", "\"" + shape + "\"", quoted_name(*c) + ", shape_of_relief");
      else
        out.assumed(kind + "_shape", "gear." + name + ".modification.", "\"linear\"",
                    shape.empty() ? "the model says none" : "the model says " + printable(shape, 40));
    } else if (kind == "profile_crowning") {
      const auto at_tip = stage.number(c, "profile_crowning_at_tip", kMicrometre),
                 at_root = stage.number(c, "profile_crowning_at_root", kMicrometre);
      if (!at_tip || !at_root || std::abs(at_tip->value - at_root->value) > 1e-9) {
        skip(": a scene has one crowning, the same at tip and root");
        continue;
      }
      begin();
      out.value("crowning_um", *at_tip);
    } else {
      skip("");
    }
  }
}

void write_errors(Stage& stage, int side, const std::string& name, Writer& out) {
  for (const char* attribute :
       {"global_tolerance_class_iso_1328_2013", "tolerance_class_according_to_iso_1328_2013"}) {
    const auto iso = stage.number(&stage.gear(side), attribute, kNumber);
    if (!iso || iso->value < 1) continue;
    out.section("# [gear." + name + ".error]   # without the # teeth differ: sweeps over many mesh periods");
    out.line("# iso_class = " + std::to_string(std::lround(iso->value)) + "   # " + iso->origin);
    return;
  }
}

std::string write_material(Stage& stage, int side, const std::string& plane, Writer& out) {
  const RexsComponent* material = stage.beside(stage.gear(side).id, "material");
  const std::string name = material ? text("material_", material->id) : text("steel_", side + 1),
                    of = "material." + name + ".";
  out.section("[material." + name + "]");
  struct Constant {
    const char *key, *attribute;
    Unit unit;
    const char* steel;
  };
  for (const Constant& c : {Constant{"youngs_modulus_GPa", "elastic_modulus", kGigapascal, "206.0"},
                            Constant{"poisson_ratio", "poisson_ratio", kNumber, "0.3"},
                            Constant{"density_kgm3", "density", kDensity, "7850.0"}}) {
    if (const auto found = stage.number(material, c.attribute, c.unit))
      out.value(c.key, *found);
    else
      out.assumed(c.key, of, c.steel, "steel");
  }
  out.value("plane", "\"" + plane + "\"", "by the width of the face: stress up to 8 modules");
  return name;
}

void write_load(Stage& stage, double teeth, Writer& out) {
  out.section("[operation]");
  const RexsComponent* shaft = stage.beside(stage.gear(0).id, "shaft");
  std::optional<Number> torque = stage.number(stage.stage_gear_data(0), "torque", kNewtonMetre);
  if (!torque) torque = stage.number(&stage.gear(0), "torque_acting_on_shaft_u", kNewtonMetre);
  if (!torque && shaft)
    torque = stage.number(stage.beside(shaft->id, "external_load"), "torque_around_u_axis", kNewtonMetre);
  if (torque && torque->value != 0)
    out.value("torque_Nm", {std::abs(torque->value), torque->origin});
  else
    out.assumed("torque_Nm", "operation.", "100.0", "the model has no torque of the driver");
  std::optional<Number> speed = stage.number(&stage.gear(0), "rotational_speed", kPerMinute);
  if (!speed) speed = stage.number(shaft, "rotational_speed", kPerMinute);
  if (speed && speed->value != 0) {
    // From a fifth of the operating speed to half beyond it, in steps of a hundredth.
    const double mesh = std::max(10.0, std::round(std::abs(speed->value) / 60 * teeth)),
                 step = std::ceil(mesh / 100);
    out.value(
        "mesh_frequency_Hz",
        text("{ from = ", std::ceil(mesh / 5), ", to = ", std::ceil(1.5 * mesh), ", step = ", step, " }"),
        text("about ", mesh, " Hz: ", speed->origin));
  } else {
    out.assumed("mesh_frequency_Hz", "operation.", "{ from = 500, to = 5000, step = 25 }",
                "the model has no speed of the driver");
  }
}

struct Written {
  std::string name;
  double module_mm, teeth;
};

Written write_gear(Stage& stage, int side, const std::string& name, const std::string& material, Writer& out,
                   RexsScene& scene) {
  const RexsComponent& gear = stage.gear(side);
  const std::string of = "gear." + name + ".";
  out.section("[gear." + name + "]   # " + quoted_name(gear));
  const Number teeth = stage.required(&gear, gear, "number_of_teeth", kNumber),
               module = stage.required(&gear, gear, "normal_module", kMillimetre),
               angle = of_flanks(stage, side, "normal_pressure_angle", kDegree),
               shift = of_flanks(stage, side, "addendum_modification_coefficient", kNumber);
  if (teeth.value != std::round(teeth.value) || teeth.value > 1e6)
    fail(Failure::input, stage.path(), ": ", teeth.origin, " = ", teeth.value, " is no number of teeth");
  out.whole("teeth", teeth);
  out.value("module_mm", module);
  out.value("pressure_angle_deg", angle);
  out.value("profile_shift", shift);
  write_heights(stage, side, of, out);
  write_thinning(stage, side, of, module.value, shift.value, angle.value, out);
  out.value("face_width_mm", stage.required(&gear, gear, "face_width", kMillimetre));
  const auto bore = stage.number(&gear, "inner_diameter", kMillimetre);
  if (bore && bore->value > 0)
    out.value("bore_radius_mm", {bore->value / 2, bore->origin});
  else
    out.assumed("bore_radius_mm", of, digits(std::round(0.3 * module.value * teeth.value * 10) / 20),
                "0.3 of the reference diameter; it decides how much the body twists");
  out.assumed("total_inertia_kgm2", of, "0.0", "as drawn, from bore to tip; add shaft and coupling");
  out.value("material", "\"" + material + "\"", "below");
  write_modifications(stage, side, name, out, scene);
  write_errors(stage, side, name, out);
  return {name, module.value, teeth.value};
}

}  // namespace

RexsScene scene_of_rexs(const RexsModel& model, const std::string& wanted, int load_case) {
  Stage stage(model, wanted, load_case);
  for (int side : {0, 1}) check_spur(stage, side);
  RexsScene scene;
  scene.stage = quoted_name(stage.stage());
  RexsScene gears, materials;
  Writer of_gears(gears), of_materials(materials);
  std::array<std::string, 2> name = {section_name(stage.gear(0)), section_name(stage.gear(1))}, material;
  if (name[0] == name[1]) name[1] += "_2";
  std::array<Written, 2> written;
  const RexsComponent* first_material = stage.beside(stage.gear(0).id, "material");
  for (int side : {0, 1}) {
    const auto s = static_cast<size_t>(side);
    const RexsComponent& gear = stage.gear(side);
    const double width = stage.required(&gear, gear, "face_width", kMillimetre).value,
                 module = stage.required(&gear, gear, "normal_module", kMillimetre).value;
    const bool shared = side == 1 && first_material == stage.beside(gear.id, "material");
    material[s] = shared
                      ? material[0]
                      : write_material(stage, side, width <= 8 * module ? "stress" : "strain", of_materials);
    written[s] = write_gear(stage, side, name[s], material[s], of_gears, gears);
  }
  Writer out(scene);
  const std::string title =
      text("\"", written[0].teeth, "/", written[1].teeth, " teeth, module ", written[0].module_mm, " mm\"");
  out.line("# Imported from a REXS model of version " + printable(model.version, 10) + ": " + scene.stage);
  out.line("title = " + title);
  scene.text += gears.text + materials.text;
  out.section("[[mesh]]");
  out.value("driver", "\"" + name[0] + "\"", quoted_name(stage.gear(0)));
  out.value("driven", "\"" + name[1] + "\"", quoted_name(stage.gear(1)));
  out.value("centre_distance_mm",
            stage.required(&stage.stage(), stage.stage(), "center_distance", kMillimetre));
  out.section("[damping]");
  out.assumed("rayleigh_stiffness_s", "damping.", "3.0e-6", "make calibrate DAMPING=0.05 finds it");
  write_load(stage, written[0].teeth, out);
  for (RexsScene* part : {&gears, &materials}) {
    scene.assumed.insert(scene.assumed.end(), part->assumed.begin(), part->assumed.end());
    scene.ignored.insert(scene.ignored.end(), part->ignored.begin(), part->ignored.end());
  }
  for (const std::string& unread : stage.unread()) scene.ignored.push_back(unread);
  if (!scene.ignored.empty()) out.line("\n# In the model and not in this scene:");
  for (const std::string& ignored : scene.ignored) out.line("# - " + ignored);
  return scene;
}

}  // namespace whine
