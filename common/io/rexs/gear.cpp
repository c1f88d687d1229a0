#include "io/rexs/gear.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/tool.h"
#include "gear/pair.h"
#include "gear/rack_tip.h"
#include "io/rexs/stage.h"

namespace whine {
namespace {

// The tool of the gear, or of one of its flanks.
const RexsComponent* tool_of(const RexsReader& reader, int gear, const std::string& type) {
  if (const RexsComponent* tool = reader.beside(gear, type)) return tool;
  for (const char* role : {"left", "right"})
    if (const RexsComponent* flank = reader.flank(gear, role))
      if (const RexsComponent* tool = reader.beside(flank->id, type)) return tool;
  return nullptr;
}

// The tip circle up to which the involute goes: a chamfer takes its end off. The tool's dedendum is not the gear's addendum: a hob
// is deeper than the teeth that it cuts, whose tips are those of the blank.
std::pair<std::string, RexsNumber> tip_of(RexsReader& reader, const RexsComponent& gear, bool internal) {
  const std::string key = "tip_diameter_mm";
  for (const char* attribute : {"tip_form_diameter", "tip_diameter"})
    if (auto diameter = reader.number(&gear, attribute, kRexsMillimetre)) {
      diameter->value = with_digits(std::abs(diameter->value), 12);
      if (attribute == std::string("tip_form_diameter")) return {key, *diameter};
      const auto chamfer = reader.of_flanks(gear.id, "tooth_tip_chamfer", kRexsMillimetre);
      if (!chamfer || chamfer->value == 0) return {key, *diameter};
      diameter->value = with_digits(diameter->value - (internal ? -2 : 2) * chamfer->value, 12);
      diameter->origin += " = " + all_digits(diameter->value + (internal ? -2 : 2) * chamfer->value) +
                          ", without the chamfer of " + all_digits(chamfer->value) + " mm (" +
                          chamfer->origin + ")";
      return {key, *diameter};
    }
  if (const auto height = reader.of_flanks(gear.id, "addendum_coefficient_basic_profile", kRexsNumber))
    return {"addendum", *height};
  return {"addendum", {1.0, "ISO 53: the model has no tip diameter", true}};
}

// The tip of the tool cuts the root of the gear.
std::pair<std::string, RexsNumber> root_of(RexsReader& reader, const RexsComponent& gear,
                                           const RexsComponent* rack, const RexsComponent* cutter) {
  if (auto diameter = reader.number(&gear, "root_diameter", kRexsMillimetre)) {
    diameter->value = std::abs(diameter->value);
    return {"root_diameter_mm", *diameter};
  }
  const char* coefficient = "addendum_coefficient_reference_profile";
  if (const auto height = reader.number(rack, coefficient, kRexsNumber)) return {"dedendum", *height};
  if (auto height = reader.number(cutter, coefficient, kRexsNumber)) {
    height->origin = "as a rack would cut it, " + height->origin;
    height->assumed = true;
    return {"dedendum", *height};
  }
  return {"dedendum", {1.25, "ISO 53, profile A", true}};
}

void take_root_radius(RexsReader& reader, const RexsComponent* rack, const RexsComponent* cutter,
                      RexsGear& gear) {
  std::optional<RexsNumber> said;
  for (const char* name : {"tip_corner_radius_factor_reference_profile", "tip_radius_factor"})
    if (!said) said = reader.number(gear.internal ? cutter : rack, name, kRexsNumber);
  // A cutter's corner of radius 0 leaves a round fillet, too.
  if (said && (said->value > 0 || !gear.internal)) {
    gear.root_radius = *said;
    return;
  }
  const double fits = default_rack_tip_radius(gear.design());
  const std::string of = "ISO 53, profile A";
  gear.root_radius = {
      fits, fits < kStandardRackTip ? text("the largest that fits; ", of, ": ", kStandardRackTip) : of, true};
}

// The one section of the shaft that a gear sits on; empty: there are several or none.
std::optional<RexsNumber> shaft_diameter(RexsReader& reader, int gear) {
  const RexsComponent *shaft = reader.beside(gear, "shaft"), *only = nullptr;
  if (!shaft) return {};
  for (const RexsComponent* c : reader.related(shaft->id)) {
    if (c->type != "shaft_section") continue;
    if (only && only != c) return {};
    only = c;
  }
  const auto begin = reader.number(only, "outer_diameter_begin", kRexsMillimetre),
             end = reader.number(only, "outer_diameter_end", kRexsMillimetre);
  return begin && end && begin->value == end->value ? begin : std::nullopt;
}

void take_clamped_radius(RexsReader& reader, const RexsComponent& gear, RexsGear& out) {
  const GearDesign d = out.design();
  const double root =
      (out.reference_radius() + (d.internal ? -1 : 1) * (d.profile_shift - d.dedendum)) * out.module.value;
  if (out.internal) {
    constexpr double kLeastRim = 2, kRim = 4;  // modules
    const auto outside = shaft_diameter(reader, gear.id);
    if (outside && outside->value / 2 >= root + kLeastRim * out.module.value)
      out.held = {outside->value / 2, "outside of its shaft, " + outside->origin, true};
    else
      out.held = {std::ceil(root + kRim * out.module.value), text(kRim, " modules of rim"), true};
    return;
  }
  const auto bore = reader.number(&gear, "inner_diameter", kRexsMillimetre);
  if (bore && bore->value > 0) {
    out.held = {bore->value / 2, bore->origin};
    return;
  }
  if (const auto shaft = shaft_diameter(reader, gear.id);
      shaft && shaft->value > 0 && shaft->value / 2 <= root - out.module.value)
    out.held = {shaft->value / 2, "its shaft, " + shaft->origin, true};
  else
    out.held = {std::round(0.6 * out.module.value * out.reference_radius() * 10) / 20,
                "0.3 of the reference diameter; it decides how much the body twists", true};
}

// ISO 21771: an arc of 2 m (x - x_E) tan(alpha) / cos(beta) is cut off by generating with x_E.
RexsNumber thinning_of(RexsReader& reader, const RexsGear& gear) {
  const RexsComponent* settings = reader.beside(gear.id, "cylindrical_gear_manufacturing_settings");
  const char* attribute = "generated_addendum_modification_coefficient";
  auto generated = reader.number(settings, attribute, kRexsNumber);
  if (!generated) generated = reader.of_flanks(gear.id, attribute, kRexsNumber);
  if (!generated) return {0, "no backlash", true};
  return {2 * gear.module.value * (gear.shift.value - generated->value) *
              std::tan(gear.angle.value * kOneDegree) / std::cos(gear.helix.value * kOneDegree),
          generated->origin};
}

// The flank that carries load: as load case or stage say, else the left one, else the only one.
struct WorkingFlank {
  const RexsComponent *flank, *other;
  std::string assumed;  // empty: as the model says
};

WorkingFlank working_flank(RexsReader& reader, int gear, const RexsFlanks& flanks) {
  std::string loaded;
  for (const RexsComponent* data : flanks.stage_data)
    if (loaded.empty()) loaded = reader.word(data, "loaded_tooth_flank");
  const bool said = loaded == "left" || loaded == "right";
  const std::string role = said ? loaded : "left", opposite = role == "left" ? "right" : "left";
  const RexsComponent *flank = reader.flank(gear, role), *other = reader.flank(gear, opposite);
  if (!flank) return {other, nullptr, "of the " + opposite + " flank, the only one that the model has"};
  if (said && !flanks.both) return {flank, other, ""};
  if (flanks.both)
    return {flank, other, "of the " + role + " flank: a planet works with both, and a scene has one"};
  return {flank, other,
          "of the left flank: the model " +
              (loaded.empty() ? "has no loaded_tooth_flank"
                              : "says loaded_tooth_flank = '" + printable(loaded, 40) + "'")};
}

std::vector<const RexsComponent*> modifications_of(const RexsReader& reader, const RexsComponent* flank) {
  std::vector<const RexsComponent*> out;
  if (flank) out = reader.related(flank->id);
  std::erase_if(out, [](const RexsComponent* c) {
    return c->type == "cylindrical_gear" || c->type == "ring_gear" || c->type == "rack_shaped_tool" ||
           c->type == "cutter_wheel_tool" || c->type == "cylindrical_gear_flank" ||
           c->type == "flank_geometry" || c->type == "cylindrical_gear_manufacturing_settings";
  });
  return out;
}

// What a scene can hold of modifications, in words that are alike for flanks that are.
std::string held_by_scene(const std::vector<const RexsComponent*>& modifications) {
  std::set<std::string> words;
  for (const RexsComponent* c : modifications) {
    if (c->type != "tip_relief" && c->type != "root_relief" && c->type != "profile_crowning" &&
        c->type != "helix_crowning")
      continue;
    std::string word = c->type;
    for (const auto& [name, attribute] : c->attributes)
      word += "\n" + name + attribute.value + attribute.unit;
    words.insert(word);
  }
  std::string all;
  for (const std::string& word : words) all += word + "\n\n";
  return all;
}

class ModificationWriter {
 public:
  ModificationWriter(RexsReader& reader, const std::string& name, const RexsComponent& flank, RexsWriter& out,
                     RexsScene& scene)
      : reader_(reader), name_(name), flank_(flank), out_(out), scene_(scene) {}

  void write(const RexsComponent& c) {
    if (written_.contains(c.type)) {
      skip(c, ": a flank of a scene has one " + printable(c.type, 40));
      return;
    }
    if (c.type == "tip_relief" || c.type == "root_relief")
      write_relief(c);
    else if (c.type == "profile_crowning")
      write_crowning(c, "crowning_um", "profile_crowning_at_tip", "profile_crowning_at_root", "tip and root");
    else if (c.type == "helix_crowning")
      write_crowning(c, "lead_crowning_um", "helix_crowning_amount_datum_face",
                     "helix_crowning_amount_non_datum_face", "both ends of the face");
    else
      skip(c, "");
  }

 private:
  void skip(const RexsComponent& c, const std::string& why) {
    scene_.ignored.push_back(quoted_name(c) + " of " + quoted_name(flank_) + why);
  }
  void begin(const RexsComponent& c) {
    if (written_.empty()) out_.section("[gear." + name_ + ".modification]   # of " + quoted_name(flank_));
    written_.insert(c.type);
  }
  std::string of() const { return "gear." + name_ + ".modification."; }

  void write_relief(const RexsComponent& c) {
    const std::string& kind = c.type;
    const auto depth = reader_.number(&c, kind + "_depth", kRexsMicrometre);
    const auto datum = reader_.number(&c, kind + "_datum_diameter", kRexsMillimetre);
    if (!depth || !datum) {
      skip(c, ": a relief needs " + kind + "_depth and " + kind + "_datum_diameter");
      return;
    }
    begin(c);
    out_.value(kind + "_um", of(), *depth);
    out_.value(kind + "_start_radius_mm", of(), {datum->value / 2, datum->origin});
    const std::string shape = reader_.word(&c, "shape_of_relief");
    if (shape == "linear" || shape == "parabolic")
      out_.value(kind + "_shape", "\"" + shape + "\"", quoted_name(c) + ", shape_of_relief");
    else
      out_.assumed(kind + "_shape", of(), "\"linear\"",
                   shape.empty() ? "the model says none" : "the model says " + printable(shape, 40));
  }

  void write_crowning(const RexsComponent& c, const char* key, const char* one, const char* other,
                      const char* ends) {
    const auto here = reader_.number(&c, one, kRexsMicrometre),
               there = reader_.number(&c, other, kRexsMicrometre);
    if (!here || !there || std::abs(here->value - there->value) > 1e-9) {
      skip(c, text(": a scene has one such crowning, the same at ", ends));
      return;
    }
    begin(c);
    out_.value(key, of(), *here);
  }

  RexsReader& reader_;
  const std::string& name_;
  const RexsComponent& flank_;
  RexsWriter& out_;
  RexsScene& scene_;
  std::set<std::string> written_;
};

void write_modifications(RexsReader& reader, int gear, const std::string& name, const RexsFlanks& flanks,
                         RexsWriter& out, RexsScene& scene) {
  const WorkingFlank works = working_flank(reader, gear, flanks);
  if (!works.flank) return;
  const auto modifications = modifications_of(reader, works.flank),
             others = modifications_of(reader, works.other);
  // Flanks with the same modifications give the same scene.
  if (!works.assumed.empty() && held_by_scene(modifications) != held_by_scene(others))
    out.assumed_of("gear." + name + ".modification", works.assumed);
  for (const RexsComponent* c : others)
    if (std::find(modifications.begin(), modifications.end(), c) == modifications.end())
      scene.ignored.push_back(quoted_name(*c) + " of " + quoted_name(*works.other) +
                              (flanks.both ? ": a planet of a scene has the same flanks in both meshes"
                                           : ": that flank carries no load"));
  ModificationWriter writer(reader, name, *works.flank, out, scene);
  for (const RexsComponent* c : modifications) writer.write(*c);
}

void write_errors(RexsReader& reader, const RexsComponent& gear, const std::string& name, RexsWriter& out) {
  for (const char* attribute :
       {"global_tolerance_class_iso_1328_2013", "tolerance_class_according_to_iso_1328_2013"}) {
    const auto iso = reader.number(&gear, attribute, kRexsNumber);
    if (!iso || iso->value < 1) continue;
    out.section("# [gear." + name + ".error]   # without the # teeth differ: sweeps over many mesh periods");
    out.line("# iso_class = " + std::to_string(std::lround(iso->value)) + "   # " + iso->origin);
    return;
  }
}

}  // namespace

std::string all_digits(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value + 0.0).ptr;  // no -0
  const std::string word(buffer, end);
  return word.find_first_of(".en") == std::string::npos ? word + ".0" : word;
}

void RexsWriter::value(const std::string& key, const std::string& value, const std::string& remark) {
  std::string start = key + " = " + value;
  start.resize(std::max<size_t>(start.size() + 1, 34), ' ');
  line(start + "# " + remark);
}

void RexsWriter::value(const std::string& key, const std::string& of, const RexsNumber& n) {
  const std::string word = key == "teeth" ? std::to_string(std::lround(n.value)) : all_digits(n.value);
  if (n.assumed)
    assumed(key, of, word, n.origin);
  else
    value(key, word, n.origin);
}

void RexsWriter::assumed(const std::string& key, const std::string& of, const std::string& word,
                         const std::string& why) {
  value(key, word, "ASSUMED: " + why);
  out_.assumed.push_back(of + key + " = " + word + ": " + why);
}

void RexsWriter::assumed_of(const std::string& section, const std::string& why) {
  line("\n# ASSUMED: [" + section + "] " + why);
  out_.assumed.push_back(section + ": " + why);
}

double RexsGear::reference_radius() const {
  return teeth.value / (2 * std::cos(helix.value * kOneDegree));
}

GearDesign RexsGear::design() const {
  GearDesign d;
  d.teeth = static_cast<int>(std::lround(teeth.value));
  d.module = module.value * 1e-3;
  d.pressure_angle = angle.value * kOneDegree;
  d.profile_shift = shift.value;
  d.helix_angle = std::abs(helix.value) * kOneDegree;
  d.hand = helix.value < 0 ? Hand::left : Hand::right;
  d.internal = internal;
  const int out = internal ? -1 : 1;  // from root to tip
  const auto height = [&](const std::pair<std::string, RexsNumber>& end, int outwards) {
    if (!end.first.ends_with("_diameter_mm")) return end.second.value;
    return outwards * out * (end.second.value / (2 * module.value) - reference_radius() - out * shift.value);
  };
  d.addendum = height(tip, 1);
  d.dedendum = height(root, -1);
  d.rack_tip_radius = root_radius.value;
  d.tooth_thinning = thinning.value * 1e-3;
  d.face_width = width.value * 1e-3;
  (internal ? d.rim_outer_radius : d.bore_radius) = held.value * 1e-3;
  return d;
}

RexsGear read_gear(RexsReader& reader, int gear, const RexsNumber& shift) {
  const RexsComponent& c = reader.component(gear);
  if (c.type != "cylindrical_gear" && c.type != "ring_gear")
    fail(Failure::input, reader.path(), ": ", quoted_name(c),
         " is no cylindrical_gear and no ring_gear; cylindrical gears are imported");
  RexsGear out;
  out.id = gear;
  out.internal = is_internal(reader, gear);
  out.teeth = teeth_of(reader, gear);
  out.module = reader.required(c, "normal_module", kRexsMillimetre);
  out.angle = pressure_angle_of(reader, gear);
  out.helix = helix_of(reader, gear);
  out.shift = shift;
  const RexsComponent *rack = tool_of(reader, gear, "rack_shaped_tool"),
                      *cutter = out.internal ? tool_of(reader, gear, "cutter_wheel_tool") : nullptr;
  out.tip = tip_of(reader, c, out.internal);
  out.root = root_of(reader, c, rack, cutter);
  out.thinning = thinning_of(reader, out);
  out.width = reader.required(c, "face_width", kRexsMillimetre);
  // A small bore and a thick rim, until they are known.
  out.held.value = out.module.value * (out.internal ? out.teeth.value / 2 + 12 : 0.1);
  take_root_radius(reader, rack, cutter, out);
  take_clamped_radius(reader, c, out);
  return out;
}

void fit_tips(RexsGear& one, RexsGear& two, double distance_mm) {
  constexpr int kSteps = 20;  // of a module
  const bool internal = one.internal || two.internal;
  // Of an internal pair the ring alone, and a step less than what just runs: teeth under load touch beyond their path of contact.
  const auto adjusts = [&](const RexsGear& gear) {
    return gear.tip.second.assumed && (!internal || gear.internal);
  };
  if (!adjusts(one) && !adjusts(two)) return;
  const auto runs = [&](int height) {
    std::array tried{one, two};
    for (RexsGear& gear : tried)
      if (adjusts(gear)) gear.tip.second.value = static_cast<double>(height) / kSteps;
    try {
      const GearPair pair(tried[0].design(), tried[1].design(), distance_mm * 1e-3);
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  int height = kSteps;
  while (height > kSteps / 2 && !runs(height + (internal ? 1 : 0))) --height;
  if (height == kSteps || height == kSteps / 2) return;
  for (const auto& [gear, mate] : {std::pair{&one, &two}, std::pair{&two, &one}}) {
    if (!adjusts(*gear)) continue;
    gear->tip.second.value = static_cast<double>(height) / kSteps;
    gear->tip.second.origin +=
        text("; 1.0 leaves its tips no room at the ", mate->teeth.value, " teeth that it meshes with");
  }
}

void write_gear(RexsReader& reader, const RexsGear& gear, const std::string& name,
                const std::string& material, const RexsFlanks& flanks, RexsWriter& out, RexsScene& scene) {
  const RexsComponent& c = reader.component(gear.id);
  const std::string of = "gear." + name + ".";
  out.section("[gear." + name + "]   # " + quoted_name(c));
  out.value("teeth", of, gear.teeth);
  if (gear.internal) out.value("internal", "true", printable(c.type, 40));
  out.value("module_mm", of, gear.module);
  out.value("pressure_angle_deg", of, gear.angle);
  if (gear.helix.value != 0) {
    out.value("helix_angle_deg", of, {std::abs(gear.helix.value), gear.helix.origin, false});
    const std::string hand = text("\"", gear.helix.value < 0 ? Hand::left : Hand::right, "\"");
    if (gear.helix.assumed)
      out.assumed("hand", of, hand, "the other hand of its mate; the model gives both the same sign");
    else
      out.value("hand", hand, "the sign of it: positive is right-hand");
  }
  out.value("profile_shift", of, gear.shift);
  out.value(gear.tip.first, of, gear.tip.second);
  out.value(gear.root.first, of, gear.root.second);
  out.value("rack_tip_radius", of, gear.root_radius);
  out.value("tooth_thinning_mm", of, gear.thinning);
  out.value("face_width_mm", of, gear.width);
  out.value(gear.internal ? "rim_outer_radius_mm" : "bore_radius_mm", of, gear.held);
  out.assumed("total_inertia_kgm2", of, "0.0", "as drawn, from bore to tip; add shaft and coupling");
  out.value("material", "\"" + material + "\"", "below");
  write_modifications(reader, gear.id, name, flanks, out, scene);
  write_errors(reader, c, name, out);
}

std::string RexsMaterials::of(const RexsGear& gear, RexsWriter& out) {
  std::vector<const RexsComponent*> found = reader_.related(gear.id);
  std::erase_if(found, [](const RexsComponent* c) { return c->type != "material"; });
  for (const RexsComponent* other : found)
    if (other != found[0])
      fail(Failure::input, reader_.path(), ": ", quoted_name(reader_.component(gear.id)),
           " has two materials, ", quoted_name(*found[0]), " and ", quoted_name(*other), "; take one out");
  const RexsComponent* material = found.empty() ? nullptr : found[0];
  const bool helical = gear.helix.value != 0;
  const std::string plane = !helical && gear.width.value <= 8 * gear.module.value ? "stress" : "strain";
  std::string name = material ? text("material_", material->id) : text("steel_", plane_.size() + 1);
  if (const auto known = plane_.find(name); known != plane_.end() && known->second != plane)
    name += "_" + plane;
  if (!plane_.emplace(name, plane).second) return name;
  const std::string of = "material." + name + ".";
  out.section("[material." + name + "]");
  struct Constant {
    const char *key, *attribute;
    RexsUnit unit;
    double steel;
  };
  for (const Constant& c : {Constant{"youngs_modulus_GPa", "elastic_modulus", kRexsGigapascal, 206},
                            Constant{"poisson_ratio", "poisson_ratio", kRexsNumber, 0.3},
                            Constant{"density_kgm3", "density", kRexsDensity, 7850}})
    out.value(c.key, of,
              reader_.number(material, c.attribute, c.unit).value_or(RexsNumber{c.steel, "steel", true}));
  out.value("plane", "\"" + plane + "\"",
            helical ? "helical: the sections of a face hold each other"
                    : "by the width of the face: stress up to 8 modules");
  return name;
}

}  // namespace whine
