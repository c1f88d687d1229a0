#include "io/rexs_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/tool.h"
#include "base/units.h"
#include "io/rexs_stage.h"
#include "io/variant.h"

namespace whine {
namespace {

// What keys of a scene are in.
constexpr RexsUnit kRexsMicrometre{"mum", RexsDimension::length, 1e-6},
    kRexsMillimetre{"mm", RexsDimension::length, 1e-3}, kRexsDegree{"deg", RexsDimension::angle, kPi / 180},
    kRexsGigapascal{"GPa", RexsDimension::pressure, 1e9}, kRexsDensity{"kg/m^3", RexsDimension::density, 1},
    kRexsNewtonMetre{"Nm", RexsDimension::moment, 1},
    kRexsPerMinute{"1/min", RexsDimension::frequency, 1.0 / 60};

// All digits, and no more.
std::string all_digits(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  const std::string word(buffer, end);
  return word.find_first_of(".en") == std::string::npos ? word + ".0" : word;
}

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
  void value(const std::string& key, const RexsNumber& n) { value(key, all_digits(n.value), n.origin); }
  void whole(const std::string& key, const RexsNumber& n) {
    value(key, std::to_string(std::lround(n.value)), n.origin);
  }
  void assumed(const std::string& key, const std::string& of, const std::string& word,
               const std::string& why) {
    value(key, word, "ASSUMED: " + why);
    out_.assumed.push_back(of + key + " = " + word + ": " + why);
  }
  // What is assumed of a whole section.
  void assumed_of(const std::string& section, const std::string& why) {
    line("\n# ASSUMED: [" + section + "] " + why);
    out_.assumed.push_back(section + ": " + why);
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
  return out.empty() || out.size() > 40 || is_folder_of_results(out) ? text("gear_", c.id) : out;
}

void check_spur(RexsStage& stage, int side) {
  const RexsComponent& gear = stage.gear(side);
  if (gear.type != "cylindrical_gear")
    fail(Failure::input, stage.path(), ": ", quoted_name(gear),
         " is no cylindrical_gear; only external spur gears are imported");
  const std::optional<RexsNumber> helix = stage.number(&gear, "helix_angle_reference_diameter", kRexsDegree);
  if (helix && helix->value != 0)
    fail(Failure::input, stage.path(), ": ", quoted_name(stage.stage()), " is helical (", helix->value,
         " degrees at ", quoted_name(gear), "); only spur gears are imported");
  const RexsNumber teeth = stage.required(&gear, gear, "number_of_teeth", kRexsNumber);
  if (teeth.value < 0)
    fail(Failure::input, stage.path(), ": ", quoted_name(gear), " is internal (", teeth.value,
         " teeth); only external spur gears are imported");
}

// Heights of the teeth: diameters where they are given, else those of the rack-shaped tool.
void write_heights(RexsStage& stage, int side, const std::string& of, Writer& out) {
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
    if (const auto diameter = stage.number(&gear, h.diameter, kRexsMillimetre))
      out.value(std::string(h.diameter) + "_mm", *diameter);
    else if (const auto coefficient = stage.number(tool, h.coefficient, kRexsNumber))
      out.value(h.key, *coefficient);
    else
      out.assumed(h.key, of, h.standard, "ISO 53, profile A");
  }
  std::optional<RexsNumber> radius;
  for (const char* name : {"tip_corner_radius_factor_reference_profile", "tip_radius_factor"})
    if (!radius) radius = stage.number(tool, name, kRexsNumber);
  if (radius)
    out.value("rack_tip_radius", *radius);
  else
    out.assumed("rack_tip_radius", of, "0.38", "ISO 53, profile A");
}

// ISO 21771: an arc of 2 m (x - x_E) tan(alpha) is cut off by generating with x_E.
void write_thinning(RexsStage& stage, int side, const std::string& of, double module_mm, double shift,
                    double angle_deg, Writer& out) {
  const RexsComponent* settings =
      stage.beside(stage.gear(side).id, "cylindrical_gear_manufacturing_settings");
  const auto generated = stage.number(settings, "generated_addendum_modification_coefficient", kRexsNumber);
  if (generated)
    out.value(
        "tooth_thinning_mm",
        {2 * module_mm * (shift - generated->value) * std::tan(angle_deg * kPi / 180), generated->origin});
  else
    out.assumed("tooth_thinning_mm", of, "0.0", "no backlash");
}

// The flank that carries load: as load case or stage say, else the left one, else the only one.
struct WorkingFlank {
  const RexsComponent *flank, *other;
  std::string assumed;  // empty: as the model says
};

WorkingFlank working_flank(RexsStage& stage, int side) {
  const std::string loaded = stage.word(stage.stage_gear_data(side), "loaded_tooth_flank");
  const bool said = loaded == "left" || loaded == "right";
  const std::string role = said ? loaded : "left", opposite = role == "left" ? "right" : "left";
  const RexsComponent *flank = stage.flank(side, role), *other = stage.flank(side, opposite);
  if (!flank) return {other, nullptr, "of the " + opposite + " flank, the only one that the model has"};
  if (said) return {flank, other, ""};
  return {flank, other,
          "of the left flank: the model " +
              (loaded.empty() ? "has no loaded_tooth_flank"
                              : "says loaded_tooth_flank = '" + printable(loaded, 40) + "'")};
}

std::vector<const RexsComponent*> modifications_of(const RexsStage& stage, const RexsComponent* flank) {
  std::vector<const RexsComponent*> out;
  if (flank) out = stage.related(flank->id);
  std::erase_if(out, [](const RexsComponent* c) {
    return c->type == "cylindrical_gear" || c->type == "rack_shaped_tool" ||
           c->type == "cylindrical_gear_flank";
  });
  return out;
}

void write_modifications(RexsStage& stage, int side, const std::string& name, Writer& out, RexsScene& scene) {
  const WorkingFlank works = working_flank(stage, side);
  const RexsComponent* flank = works.flank;
  if (!flank) return;
  const auto modifications = modifications_of(stage, flank), others = modifications_of(stage, works.other);
  // Flanks with the same modifications give the same scene.
  if (!works.assumed.empty() &&
      std::set(modifications.begin(), modifications.end()) != std::set(others.begin(), others.end()))
    out.assumed_of("gear." + name + ".modification", works.assumed);
  for (const RexsComponent* c : others)
    if (std::find(modifications.begin(), modifications.end(), c) == modifications.end())
      scene.ignored.push_back(quoted_name(*c) + " of " + quoted_name(*works.other) +
                              ": that flank carries no load");
  std::set<std::string> written;
  for (const RexsComponent* c : modifications) {
    const std::string kind = c->type;
    const bool tip = kind == "tip_relief", root = kind == "root_relief";
    const auto skip = [&](const std::string& why) {
      scene.ignored.push_back(quoted_name(*c) + " of " + quoted_name(*flank) + why);
    };
    if (written.contains(kind)) {
      skip(": a flank of a scene has one " + kind);
      continue;
    }
    const auto begin = [&] {
      if (written.empty()) out.section("[gear." + name + ".modification]   # of " + quoted_name(*flank));
      written.insert(kind);
    };
    if (tip || root) {
      const auto depth = stage.number(c, kind + "_depth", kRexsMicrometre);
      const auto datum = stage.number(c, kind + "_datum_diameter", kRexsMillimetre);
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
      const auto at_tip = stage.number(c, "profile_crowning_at_tip", kRexsMicrometre),
                 at_root = stage.number(c, "profile_crowning_at_root", kRexsMicrometre);
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

void write_errors(RexsStage& stage, int side, const std::string& name, Writer& out) {
  for (const char* attribute :
       {"global_tolerance_class_iso_1328_2013", "tolerance_class_according_to_iso_1328_2013"}) {
    const auto iso = stage.number(&stage.gear(side), attribute, kRexsNumber);
    if (!iso || iso->value < 1) continue;
    out.section("# [gear." + name + ".error]   # without the # teeth differ: sweeps over many mesh periods");
    out.line("# iso_class = " + std::to_string(std::lround(iso->value)) + "   # " + iso->origin);
    return;
  }
}

std::string write_material(RexsStage& stage, int side, const std::string& plane, Writer& out) {
  const RexsComponent* material = stage.beside(stage.gear(side).id, "material");
  const std::string name = material ? text("material_", material->id) : text("steel_", side + 1),
                    of = "material." + name + ".";
  out.section("[material." + name + "]");
  struct Constant {
    const char *key, *attribute;
    RexsUnit unit;
    const char* steel;
  };
  for (const Constant& c : {Constant{"youngs_modulus_GPa", "elastic_modulus", kRexsGigapascal, "206.0"},
                            Constant{"poisson_ratio", "poisson_ratio", kRexsNumber, "0.3"},
                            Constant{"density_kgm3", "density", kRexsDensity, "7850.0"}}) {
    if (const auto found = stage.number(material, c.attribute, c.unit))
      out.value(c.key, *found);
    else
      out.assumed(c.key, of, c.steel, "steel");
  }
  out.value("plane", "\"" + plane + "\"", "by the width of the face: stress up to 8 modules");
  return name;
}

void write_load(RexsStage& stage, double teeth, Writer& out) {
  out.section("[operation]");
  const RexsComponent* shaft = stage.beside(stage.gear(0).id, "shaft");
  std::optional<RexsNumber> torque = stage.number(stage.stage_gear_data(0), "torque", kRexsNewtonMetre);
  if (!torque) torque = stage.number(&stage.gear(0), "torque_acting_on_shaft_u", kRexsNewtonMetre);
  if (!torque && shaft)
    torque = stage.number(stage.beside(shaft->id, "external_load"), "torque_around_u_axis", kRexsNewtonMetre);
  if (torque && torque->value != 0)
    out.value("torque_Nm", {std::abs(torque->value), torque->origin});
  else
    out.assumed("torque_Nm", "operation.", "100.0", "the model has no torque of the driver");
  std::optional<RexsNumber> speed = stage.number(&stage.gear(0), "rotational_speed", kRexsPerMinute);
  if (!speed) speed = stage.number(shaft, "rotational_speed", kRexsPerMinute);
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

Written write_gear(RexsStage& stage, int side, const std::string& name, const std::string& material,
                   Writer& out, RexsScene& scene) {
  const RexsComponent& gear = stage.gear(side);
  const std::string of = "gear." + name + ".";
  out.section("[gear." + name + "]   # " + quoted_name(gear));
  const RexsNumber teeth = stage.required(&gear, gear, "number_of_teeth", kRexsNumber),
                   module = stage.required(&gear, gear, "normal_module", kRexsMillimetre),
                   angle = stage.of_flanks(side, "normal_pressure_angle", kRexsDegree),
                   shift = stage.of_flanks(side, "addendum_modification_coefficient", kRexsNumber);
  if (teeth.value != std::round(teeth.value) || teeth.value > 1e6)
    fail(Failure::input, stage.path(), ": ", teeth.origin, " = ", teeth.value, " is no number of teeth");
  out.whole("teeth", teeth);
  out.value("module_mm", module);
  out.value("pressure_angle_deg", angle);
  out.value("profile_shift", shift);
  write_heights(stage, side, of, out);
  write_thinning(stage, side, of, module.value, shift.value, angle.value, out);
  out.value("face_width_mm", stage.required(&gear, gear, "face_width", kRexsMillimetre));
  const auto bore = stage.number(&gear, "inner_diameter", kRexsMillimetre);
  if (bore && bore->value > 0)
    out.value("bore_radius_mm", {bore->value / 2, bore->origin});
  else
    out.assumed("bore_radius_mm", of, all_digits(std::round(0.3 * module.value * teeth.value * 10) / 20),
                "0.3 of the reference diameter; it decides how much the body twists");
  out.assumed("total_inertia_kgm2", of, "0.0", "as drawn, from bore to tip; add shaft and coupling");
  out.value("material", "\"" + material + "\"", "below");
  write_modifications(stage, side, name, out, scene);
  write_errors(stage, side, name, out);
  return {name, module.value, teeth.value};
}

}  // namespace

RexsScene scene_of_rexs(const RexsModel& model, const std::string& wanted, int load_case) {
  RexsStage stage(model, wanted, load_case);
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
    const double width = stage.required(&gear, gear, "face_width", kRexsMillimetre).value,
                 module = stage.required(&gear, gear, "normal_module", kRexsMillimetre).value;
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
  if (stage.driver_assumed().empty())
    out.value("driver", "\"" + name[0] + "\"", quoted_name(stage.gear(0)));
  else
    out.assumed("driver", "mesh.", "\"" + name[0] + "\"", stage.driver_assumed());
  out.value("driven", "\"" + name[1] + "\"", quoted_name(stage.gear(1)));
  out.value("centre_distance_mm",
            stage.required(&stage.stage(), stage.stage(), "center_distance", kRexsMillimetre));
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
