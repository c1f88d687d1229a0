#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "gear/handbook_sign.h"
#include "gear/rack_tip.h"
#include "io/scene_sections.h"
#include "io/variant.h"

namespace whine {
namespace {

// Named sections below [group]: [gear.pinion], [material.steel]; in the order in which they are written.
std::vector<SectionReader> named_sections(const Source& source, const std::string& group) {
  std::vector<std::pair<std::string, const toml::table*>> found;
  if (const toml::table* table = source.section(group))
    for (const auto& [key, node] : *table) {
      const std::string name(key.str());
      if (!node.is_table())
        source.reject_line(key.source().begin.line, "'", name, "' stands in [", group,
                           "] itself; keys belong into [", group, ".<name>]");
      if (!plain_name(name))
        source.reject_line(key.source().begin.line, "[", group, ".", name,
                           "]: a name holds letters, digits, '_' and '-' only");
      found.emplace_back(name, node.as_table());
    }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.second->source().begin.line < b.second->source().begin.line;
  });
  std::vector<SectionReader> out;
  out.reserve(found.size());
  for (const auto& [name, table] : found) out.emplace_back(source, *table, group, group + "." + name, name);
  return out;
}

std::vector<std::string> names_of(const std::vector<SectionReader>& sections) {
  std::vector<std::string> names;
  names.reserve(sections.size());
  for (const SectionReader& section : sections) names.push_back(section.name());
  return names;
}

// What [gear.<name>] says.
struct GearValues {
  GearDesign design;
  GearWords words;
  FlankModification modification;
  ToothErrors errors;
};

// Fills what stands in [gear.<name>.modification], if that is there.
void read_modification(const SectionReader& gear, FlankModification& modification) {
  const auto own = gear.below("modification");
  if (!own) return;
  own->reject_unknown();
  const auto forms = [](const std::string& end) {
    return text(end, "_relief_start_deg, ", end, "_relief_start_radius_mm, ", end, "_relief_length_mm");
  };
  const std::array<std::pair<std::string, Relief*>, 2> ends{
      {{"tip", &modification.tip}, {"root", &modification.root}}};
  // A start given here takes the place of one taken over from another gear, in whatever form.
  for (const auto& [end, relief] : ends) {
    std::vector<const toml::node*> given;
    for (const char* form : {"_start_deg", "_start_radius_mm", "_length_mm"})
      if (const toml::node* start = own->node(text(end, "_relief", form))) given.push_back(start);
    if (given.size() > 1)
      own->reject_at(*given[1], " says the start of ", end, "_relief ", given.size(), " times; give one of ",
                     forms(end));
    if (!given.empty()) relief->start_roll = relief->start_radius = relief->length = 0;
  }
  own->read(keys(modification).append(keys(modification.lead)), true);
  if ((modification.lead.end_relief > 0) != (modification.lead.end_relief_length > 0))
    own->reject(
        " gives one of end_relief_um and end_relief_length_mm; an end relief is as much at the end of the face, from so far before it: give both");
  for (const auto& [end, relief] : ends)
    if (relief->amount > 0 && !(relief->start_roll > 0 || relief->start_radius > 0 || relief->length > 0))
      own->reject(" lacks the start of ", end, "_relief_um = ", relief->amount * 1e6, "; give one of ",
                  forms(end));
}

// Fills what stands in [gear.<name>.error] and in the file that it names, if it is there. Errors are a gear's own: `like` does
// not take them over.
void read_errors(const SectionReader& gear, GearValues& values) {
  values.errors = {};
  const auto own = gear.below("error");
  if (!own) return;
  own->reject_unknown();
  std::string file;
  own->read(error_file_key(file));
  if (!file.empty()) {
    const std::filesystem::path name = std::filesystem::path(own->source().path()).parent_path() / file;
    if (name.extension() != ".toml" && name.extension() != ".csv")
      own->reject_key("file", " = '", file, "' is neither a .toml nor a .csv");
    const Source measured =
        name.extension() == ".csv" ? Source::table_of_teeth(name.string()) : Source(name.string());
    if (const toml::node* another = measured.root().get("file"))
      measured.reject(*another, "a file of measured errors cannot name another");
    SectionReader(measured, measured.root(), "error", "").read_all(keys(values.errors));
  }
  const KeyList errors = keys(values.errors);
  own->read(errors, !file.empty());
  for (const Key& key : errors)
    if (const auto* list = std::get_if<std::vector<double>*>(&key.slot))
      if (const std::size_t count = (*list)->size();
          count > 0 && count != static_cast<std::size_t>(values.design.teeth))
        own->reject_key(key.name, " holds ", count, " numbers, the gear has ", values.design.teeth,
                        " teeth; give one for each");
}

// Fills what stands in [gear.<name>.crack]. A crack is damage, not design: a gear that is `like` another has none of it.
void read_crack(const SectionReader& gear, GearDesign& design) {
  design.crack = Crack{};
  const auto own = gear.below("crack");
  if (!own) return;
  GearDesign cracked;
  own->read_all(keys(cracked).section("crack"));
  if (cracked.crack.tooth >= design.teeth)
    own->reject_key("tooth", " = ", cracked.crack.tooth, ": the gear has the teeth 0 to ", design.teeth - 1);
  if (cracked.crack.depth > 0) design.crack = cracked.crack;
}

// Reads [gear.<name>] itself. An internal gear has a rim and no bore; what `internal` is otherwise is rejected when it is read.
void read_design(const SectionReader& gear, GearValues& values, bool inherit,
                 const std::set<std::string>& optional) {
  const toml::node* node = gear.node("internal");
  const bool internal = node && node->is_boolean() ? node->value_or(false) : values.design.internal;
  const KeyList own = keys(values.design, &values.words).section("gear");
  gear.read(internal ? own.without({"bore_radius_mm"}) : own, inherit, optional);
}

// The support of a rim has two stiffnesses or none.
void require_rim_support(const SectionReader& gear, bool rigid, GearDesign& d) {
  constexpr const char* kKeys[] = {"rim_radial_stiffness_N_mm2", "rim_tangential_stiffness_N_mm2"};
  for (const char* key : kKeys) {
    if (!d.internal)
      gear.reject_given(key,
                        ", which only an internal gear has; write internal = true, or take the line out");
    if (rigid)
      gear.reject_given(
          key,
          ", but the gears of this scene are rigid, rims included; take the line out, or the line body = \"rigid\" in [fidelity]");
  }
  if (!d.internal) d.rim_radial_stiffness = d.rim_tangential_stiffness = 0;
  // Softer ones make the rim's motion as a whole so large that what teeth do to each other drowns in the error of its table.
  constexpr double kLeast = 2e7;
  const double given[] = {d.rim_radial_stiffness, d.rim_tangential_stiffness};
  for (const int i : {0, 1})
    if (given[i] > 0 && given[i] < kLeast)
      gear.reject_key(
          kKeys[i], " = ", given[i] * 1e-6, " is below ", kLeast * 1e-6,
          ", the softest support that is computed: the rim would move as a whole by micrometres for some newtons; of a ring that floats give a [[bearing]]");
  if ((d.rim_radial_stiffness > 0) == (d.rim_tangential_stiffness > 0)) return;
  const int lacks = d.rim_radial_stiffness > 0 ? 1 : 0;
  gear.reject(
      " gives '", kKeys[1 - lacks], "' and '", kKeys[lacks],
      "' is 0: a support that is elastic one way and rigid the other is not computed; give both above 0, or neither for a rigid housing");
}

// What holds a gear: an internal one its rim, an external one its bore; neither takes over the other's.
void require_blank(const SectionReader& gear, GearDesign& d) {
  if (d.internal) {
    if (const toml::node* bore = gear.node("bore_radius_mm"))
      gear.reject_at(
          *bore,
          " is internal and gives 'bore_radius_mm'; its ring is held outside: give 'rim_outer_radius_mm' in its place");
    d.bore_radius = 0;
    if (d.rim_outer_radius == 0)
      gear.reject(
          " lacks 'rim_outer_radius_mm' (no default), the radius outside which the ring is as good as rigid");
  } else {
    gear.reject_given("rim_outer_radius_mm",
                      ", which only an internal gear has; write internal = true, or take the line out");
    d.rim_outer_radius = 0;
    if (d.bore_radius == 0) gear.reject(" lacks 'bore_radius_mm' (no default)");
  }
}

// A rigid gear's face and rim, where the scene does not say them; no result depends on them.
void fill_blank(GearDesign& d) {
  if (d.face_width == 0) d.face_width = 10 * d.module;
  if (d.internal && d.rim_outer_radius == 0)
    d.rim_outer_radius = d.module * (0.5 * d.teeth + std::abs(d.profile_shift) + d.dedendum + 2);
}

// What a rigid gear of a train cannot have, and its inertia, which it needs. like: see model_of().
void take_rigid(const SectionReader& gear, const SectionReader* like, SceneGear& own) {
  for (const char* key : {"modification", "error", "crack"})
    if (const toml::node* node = gear.node(key))
      gear.source().reject(*node, "[", gear.label(), ".", key,
                           "]: a gear of a system with body = \"rigid\" has no '", key,
                           "', its mesh is one spring of stiffness_N_um; take the section out");
  const bool inherits = like && !gear.node("equivalent_mass_kg");
  SectionReader(gear.source(), inherits ? like->table() : gear.table(), "rigid_gear", gear.label())
      .read(equivalent_mass_key(own.equivalent_mass));
  if (own.equivalent_mass > 0 && own.total_inertia > 0)
    gear.reject(" gives 'total_inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them");
  if (!(own.equivalent_mass > 0 || own.total_inertia > 0))
    gear.reject(
        " of a system with body = \"rigid\" lacks its inertia: give 'total_inertia_kgm2' or 'equivalent_mass_kg'");
}

// Turns the diameters of tip and root into addendum and dedendum. `like`: the gear whose keys `values` began with, nullptr:
// none.
void take_diameters(const SectionReader& gear, const GearDesign* like, GearValues& values) {
  GearDesign& d = values.design;
  // Of one end, in modules beyond the reference circle; the tip +1, the root -1.
  const auto take = [&](const char* diameter_key, const char* height_key, double& diameter, double& height,
                        int outwards) {
    const bool own = gear.node(diameter_key);
    if (gear.node(height_key)) {
      gear.reject_given(diameter_key, " and '", height_key, "', which say the same; give one of them");
      diameter = 0;
    }
    if (diameter == 0) return;
    if (!own && like &&
        (like->teeth != d.teeth || like->module != d.module || like->profile_shift != d.profile_shift ||
         like->internal != d.internal || like->helix_angle != d.helix_angle))
      gear.reject(" takes '", diameter_key, "' = ", diameter * 1e3,
                  " over from a gear of other teeth, module, profile_shift, helix or kind; give '",
                  diameter_key, "' or '", height_key, "' here");
    const int out = d.internal ? -1 : 1;                     // from root to tip
    const double teeth = d.teeth / std::cos(d.helix_angle);  // in normal modules
    const double exact = outwards * out * (diameter / (2 * d.module) - teeth / 2.0 - out * d.profile_shift);
    // A drawing has fewer digits than round-off leaves: 1, not 1 + 4e-15, makes the body of addendum = 1.
    constexpr double kDigits = 1e12;
    height = std::round(exact * kDigits) / kDigits;
    constexpr double kMost = 3;  // the range of addendum and dedendum
    if (height > 0 && height <= kMost) return;
    // Of a ring whose shift is counted outwards.
    const double other = height + outwards * 2 * d.profile_shift;
    const bool other_sign = d.internal && other >= 0.6 && other <= 1.6;
    const double pitch = d.module * (teeth + 2 * out * d.profile_shift),
                 limit = pitch + outwards * out * 2 * kMost * d.module;
    gear.reject_key(diameter_key, " = ", diameter * 1e3, ": with ", d.teeth,
                    " teeth, module_mm = ", d.module * 1e3, " and profile_shift = ", d.profile_shift,
                    " it must be between ", std::min(pitch, limit) * 1e3, " and ",
                    std::max(pitch, limit) * 1e3, " mm (", height_key, " above 0, at most 3)",
                    other_sign ? "; " + other_sign_words(-d.profile_shift) : "");
  };
  take("tip_diameter_mm", "addendum", values.words.tip_diameter, d.addendum, 1);
  take("root_diameter_mm", "dedendum", values.words.root_diameter, d.dedendum, -1);
}

// The name of a gear that is misspelt in [gear.<name>.modification] is that of a gear which has nothing else. A gear has a folder
// beside those of results, which is a link to its body: what is made in a folder of its name would land there.
void require_name(const SectionReader& gear, std::vector<std::string> names) {
  const std::string& name = gear.name();
  if (is_folder_of_results(name))
    gear.reject(": a gear cannot be called '", name, "', a folder of results is; choose another name");
  if (name.size() > kLongestName)
    gear.source().reject(gear.table(), "[gear.", name.substr(0, 40), "...]: its name has ", name.size(),
                         " letters; it becomes a folder, so it may have ", kLongestName, " at most");
  const toml::table& table = gear.table();
  if (table.empty() ||
      !std::all_of(table.begin(), table.end(), [](const auto& entry) { return entry.second.is_table(); }))
    return;
  std::erase(names, name);
  gear.source().reject(*table.begin()->second.as_table(), "[gear.", name, ".", table.begin()->first.str(),
                       "]: there is no [gear.", name, "] with teeth", advice_for(name, names));
}

// The gear that [gear.<name>] is like; nullptr: none.
const SectionReader* model_of(const SectionReader& gear, const std::vector<SectionReader>& gears) {
  const toml::node* like = gear.node("like");
  if (!like || !like->is_string()) return nullptr;
  const std::string base = like->value_or(std::string());
  if (base == gear.name()) gear.reject_at(*like, " is like itself");
  for (const SectionReader& model : gears) {
    if (model.name() != base) continue;
    if (const toml::node* chain = model.node("like"))
      gear.reject_at(*like, " is like [gear.", base, "], which is like ", as_written(*chain),
                     " itself; name the first gear");
    return &model;
  }
  gear.reject_key("like", " names no gear: '", base, "'", advice_for(base, names_of(gears)));
}

}  // namespace

void read_gears(const Source& source, Scene& scene, bool rigid) {
  // What a rigid gear does without: it is drawn, and its mesh checked, with a face and a rim of its own.
  const std::set<std::string> optional =
      rigid ? std::set<std::string>{"material", "face_width_mm", "bore_radius_mm"} : std::set<std::string>{};
  const auto materials = named_sections(source, "material"), gears = named_sections(source, "gear");
  std::map<std::string, Material> material;
  for (const SectionReader& own : materials) own.read_all(keys(material[own.name()]));
  std::vector<std::string> below{"crack", "modification", "error"};
  if (rigid) below.push_back("equivalent_mass_kg");
  for (const SectionReader& gear : gears) {
    require_name(gear, names_of(gears));
    gear.reject_unknown(below);
    GearValues values;
    GearDesign base_design;
    const SectionReader* model = model_of(gear, gears);
    if (model) {
      read_design(*model, values, false, optional);
      take_diameters(*model, nullptr, values);
      base_design = values.design;
      read_modification(*model, values.modification);
    }
    read_design(gear, values, gear.node("like"), optional);
    if (rigid)
      fill_blank(values.design);
    else
      require_blank(gear, values.design);
    require_rim_support(gear, rigid, values.design);
    if (!values.design.helical())
      gear.reject_given("hand", ", and the gear is not helical; give helix_angle_deg, or take the line out");
    take_diameters(gear, model ? &base_design : nullptr, values);
    if (!gear.node("rack_tip_radius") && !(model && model->node("rack_tip_radius")))
      values.design.rack_tip_radius = default_rack_tip_radius(values.design);
    read_modification(gear, values.modification);
    read_errors(gear, values);
    read_crack(gear, values.design);
    const std::string& own = values.words.material;
    if (rigid && own.empty())
      material[""] = {};
    else if (!material.contains(own))
      gear.reject_key("material", " = '", own, "' names no [material.<name>] section",
                      advice_for(own, names_of(materials)));
    scene.gears.push_back({gear.name(), values.design, material.at(own), values.words.total_inertia,
                           values.modification, values.errors});
    if (rigid) take_rigid(gear, model, scene.gears.back());
  }
}

}  // namespace whine
