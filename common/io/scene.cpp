#include "io/scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "gear/handbook_sign.h"
#include "gear/rack_tip.h"
#include "io/keys.h"
#include "io/module_lengths.h"
#include "io/scene_sections.h"
#include "io/section_reader.h"
#include "io/suggestion.h"
#include "io/variant.h"

namespace whine {
namespace {

const char* const kExample = "data/scenes/first-pair.toml explains a whole scene line by line";

// Named sections below [group]: [gear.pinion], [material.steel].
std::vector<std::pair<std::string, const toml::table*>> named_sections(const Source& source,
                                                                       const std::string& group) {
  std::vector<std::pair<std::string, const toml::table*>> out;
  const toml::table* table = source.section(group);
  if (!table) return out;
  for (const auto& [key, node] : *table) {
    const std::string name(key.str());
    const auto* section = node.as_table();
    if (!section) {
      source.reject_line(key.source().begin.line, text("'", name, "' stands in [", group,
                                                       "] itself; keys belong into [", group, ".<name>]"));
    }
    if (!plain_name(name)) {
      source.reject_line(key.source().begin.line,
                         text("[", group, ".", name, "]: a name holds letters, digits, '_' and '-' only"));
    }
    out.emplace_back(name, section);
  }
  // toml++ keeps keys in alphabetical order; scenes are read in the order in which they are written.
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return a.second->source().begin.line < b.second->source().begin.line;
  });
  return out;
}

std::vector<std::string> section_names(
    const std::vector<std::pair<std::string, const toml::table*>>& sections) {
  std::vector<std::string> names;
  names.reserve(sections.size());
  for (const auto& section : sections) names.push_back(section.first);
  return names;
}

}  // namespace

std::string advice_for(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? text("; known are: ", joined(known)) : text("; did you mean '", near, "'?");
}

namespace {

// What [gear.<name>] says.
struct GearValues {
  GearDesign design;
  GearWords words;
  FlankModification modification;
  ToothErrors errors;
};

// Fills what stands in [gear.<name>.modification], if that is there.
void read_modification(const Source& source, const toml::table& gear, const std::string& label,
                       FlankModification& modification) {
  const toml::node* node = gear.get("modification");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.reject(
        *node, text("'modification' in [", label, "] must be a section: write [", label, ".modification]"));
  const std::string own = label + ".modification";
  const SectionReader reader(source, Dialect::scene, *table, "modification", own);
  reader.reject_unknown();
  // A start given here takes the place of one taken over from another gear, in whatever form.
  const auto starts = [&](const char* end) {
    std::vector<const toml::node*> given;
    for (const char* form : {"_start_deg", "_start_radius_mm", "_length_mm"})
      if (const toml::node* start = table->get(text(end, "_relief", form))) given.push_back(start);
    if (given.size() > 1)
      source.reject(*given[1], text("[", own, "] says the start of ", end, "_relief ", given.size(),
                                    " times; give one of ", end, "_relief_start_deg, ", end,
                                    "_relief_start_radius_mm, ", end, "_relief_length_mm"));
    return !given.empty();
  };
  for (const auto& [end, relief] :
       {std::pair{"tip", &modification.tip}, std::pair{"root", &modification.root}})
    if (starts(end)) relief->start_roll = relief->start_radius = relief->length = 0;
  reader.read(keys(modification), true);
  for (const auto& [end, relief] : {std::pair{"tip", modification.tip}, std::pair{"root", modification.root}})
    if (relief.amount > 0 && !(relief.start_roll > 0 || relief.start_radius > 0 || relief.length > 0))
      source.reject(*table, text("[", own, "] lacks the start of ", end, "_relief_um = ", relief.amount * 1e6,
                                 "; give one of ", end, "_relief_start_deg, ", end,
                                 "_relief_start_radius_mm, ", end, "_relief_length_mm"));
}

// Fills what stands in [gear.<name>.error] and in the file that it names, if it is there. Errors are a gear's own: `like` does
// not take them over.
void read_errors(const Source& source, const toml::table& gear, const std::string& label,
                 GearValues& values) {
  values.errors = {};
  const toml::node* node = gear.get("error");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.reject(*node, text("'error' in [", label, "] must be a section: write [", label, ".error]"));
  const SectionReader reader(source, Dialect::scene, *table, "error", label + ".error");
  reader.reject_unknown();
  std::string file;
  reader.read(error_file_key(file));
  if (!file.empty()) {
    const std::filesystem::path name = std::filesystem::path(source.path()).parent_path() / file;
    if (name.extension() != ".toml" && name.extension() != ".csv")
      source.reject(*table->get("file"),
                    text("'file' in [", label, ".error] = '", file, "' is neither a .toml nor a .csv"));
    const Source measured =
        name.extension() == ".csv" ? Source::table_of_teeth(name.string()) : Source(name.string());
    if (const toml::node* another = measured.root().get("file"))
      measured.reject(*another, "a file of measured errors cannot name another");
    const SectionReader lists(measured, Dialect::scene, measured.root(), "error", "");
    lists.reject_unknown();
    lists.read(keys(values.errors));
  }
  reader.read(keys(values.errors), !file.empty());
  for (const auto& [key, list] : {std::pair{"single_pitch_um", &values.errors.single_pitch},
                                  std::pair{"cumulative_pitch_um", &values.errors.cumulative_pitch},
                                  std::pair{"profile_slope_um", &values.errors.profile_slope},
                                  std::pair{"profile_form_um", &values.errors.profile_form}})
    if (!list->empty() && static_cast<int>(list->size()) != values.design.teeth) {
      const toml::node* at = table->get(key);
      source.reject(at ? *at : *table,
                    text("'", key, "' in [", label, ".error] holds ", list->size(), " numbers, the gear has ",
                         values.design.teeth, " teeth; give one for each"));
    }
}

// Fills what stands in [gear.<name>.crack]. A crack is damage, not design: a gear that is `like` another has none of it.
void read_crack(const Source& source, const toml::table& gear, const std::string& label, GearDesign& design) {
  design.crack = Crack{};
  const toml::node* node = gear.get("crack");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.reject(*node, text("'crack' in [", label, "] must be a section: write [", label, ".crack]"));
  const SectionReader reader(source, Dialect::scene, *table, "crack", label + ".crack");
  reader.reject_unknown();
  GearDesign cracked;
  const Crack& crack = cracked.crack;
  reader.read(keys(cracked).section("crack"));
  if (crack.tooth >= design.teeth)
    source.reject(*table->get("tooth"), text("'tooth' in [", label, ".crack] = ", crack.tooth,
                                             ": the gear has the teeth 0 to ", design.teeth - 1));
  if (crack.depth > 0) design.crack = crack;
}

// internal: the gear has a rim and no bore.
KeyList gear_keys(GearValues& values, bool internal) {
  const KeyList own = keys(values.design, &values.words).section("gear");
  return internal ? own.without({"bore_radius_mm"}) : own;
}

// Whether [gear.<name>] says so; what it says otherwise is rejected when it is read.
bool says_internal(const toml::table& table, bool inherited) {
  const toml::node* node = table.get("internal");
  return node && node->is_boolean() ? node->value<bool>().value_or(false) : inherited;
}

// The support of a rim has two stiffnesses or none.
void require_rim_support(const Source& source, const toml::table& table, const std::string& label, bool rigid,
                         GearDesign& d) {
  constexpr const char* kKeys[] = {"rim_radial_stiffness_N_mm2", "rim_tangential_stiffness_N_mm2"};
  for (const char* key : kKeys) {
    const toml::node* node = table.get(key);
    if (node && !d.internal)
      source.reject(*node,
                    text("[", label, "] gives '", key,
                         "', which only an internal gear has; write internal = true, or take the line out"));
    if (node && rigid)
      source.reject(
          *node,
          text(
              "[", label, "] gives '", key,
              "', but the gears of this scene are rigid, rims included; take the line out, or the line body = \"rigid\" in [fidelity]"));
  }
  if (!d.internal) d.rim_radial_stiffness = d.rim_tangential_stiffness = 0;
  // Softer ones make the rim's motion as a whole so large that what teeth do to each other drowns in the error of its table.
  constexpr double kLeast = 2e7;
  const double given[] = {d.rim_radial_stiffness, d.rim_tangential_stiffness};
  for (const int i : {0, 1})
    if (given[i] > 0 && given[i] < kLeast) {
      const toml::node* node = table.get(kKeys[i]);
      source.reject(
          node ? *node : static_cast<const toml::node&>(table),
          text(
              "'", kKeys[i], "' in [", label, "] = ", given[i] * 1e-6, " is below ", kLeast * 1e-6,
              ", the softest support that is computed: the rim would move as a whole by micrometres for some newtons; of a ring that floats give a [[bearing]]"));
    }
  if ((d.rim_radial_stiffness > 0) == (d.rim_tangential_stiffness > 0)) return;
  const int lacks = d.rim_radial_stiffness > 0 ? 1 : 0;
  source.reject(
      table,
      text(
          "[", label, "] gives '", kKeys[1 - lacks], "' and '", kKeys[lacks],
          "' is 0: a support that is elastic one way and rigid the other is not computed; give both above 0, or neither for a rigid housing"));
}

// What holds a gear: an internal one its rim, an external one its bore; neither takes over the other's.
void require_blank(const Source& source, const toml::table& table, const std::string& label, GearDesign& d) {
  if (d.internal) {
    if (const toml::node* bore = table.get("bore_radius_mm"))
      source.reject(
          *bore,
          text(
              "[", label,
              "] is internal and gives 'bore_radius_mm'; its ring is held outside: give 'rim_outer_radius_mm' in its place"));
    d.bore_radius = 0;
    if (d.rim_outer_radius == 0)
      source.reject(
          table,
          text(
              "[", label,
              "] lacks 'rim_outer_radius_mm' (no default), the radius outside which the ring is as good as rigid"));
  } else {
    if (const toml::node* rim = table.get("rim_outer_radius_mm"))
      source.reject(
          *rim,
          text(
              "[", label,
              "] gives 'rim_outer_radius_mm', which only an internal gear has; write internal = true, or take the line out"));
    d.rim_outer_radius = 0;
    if (d.bore_radius == 0) source.reject(table, text("[", label, "] lacks 'bore_radius_mm' (no default)"));
  }
}

// A rigid gear's face and rim, where the scene does not say them; no result depends on them.
void fill_blank(GearDesign& d) {
  if (d.face_width == 0) d.face_width = 10 * d.module;
  if (d.internal && d.rim_outer_radius == 0)
    d.rim_outer_radius = d.module * (0.5 * d.teeth + std::abs(d.profile_shift) + d.dedendum + 2);
}

// Turns the diameters of tip and root into addendum and dedendum. `like`: the gear whose keys `values` began with, nullptr:
// none.
void take_diameters(const Source& source, const toml::table& table, const std::string& label,
                    const GearDesign* like, GearValues& values) {
  GearDesign& d = values.design;
  // Of one end, in modules beyond the reference circle; the tip +1, the root -1.
  const auto take = [&](const char* diameter_key, const char* height_key, double& diameter, double& height,
                        int outwards) {
    const toml::node *own = table.get(diameter_key), *own_height = table.get(height_key);
    if (own && own_height)
      source.reject(*own, text("[", label, "] gives '", diameter_key, "' and '", height_key,
                               "', which say the same; give one of them"));
    if (own_height) diameter = 0;
    if (diameter == 0) return;
    const toml::node& at = own ? *own : static_cast<const toml::node&>(table);
    if (!own && like &&
        (like->teeth != d.teeth || like->module != d.module || like->profile_shift != d.profile_shift ||
         like->internal != d.internal))
      source.reject(at, text("[", label, "] takes '", diameter_key, "' = ", diameter * 1e3,
                             " over from a gear of other teeth, module, profile_shift or kind; give '",
                             diameter_key, "' or '", height_key, "' here"));
    const int out = d.internal ? -1 : 1;  // from root to tip
    const double exact = outwards * out * (diameter / (2 * d.module) - d.teeth / 2.0 - out * d.profile_shift);
    // A drawing has fewer digits than round-off leaves: 1, not 1 + 4e-15, makes the body of addendum = 1.
    constexpr double kDigits = 1e12;
    height = std::round(exact * kDigits) / kDigits;
    constexpr double kMost = 3;  // the range of addendum and dedendum
    if (height > 0 && height <= kMost) return;
    // Of a ring whose shift is counted outwards.
    const double other = height + outwards * 2 * d.profile_shift;
    const bool other_sign = d.internal && other >= 0.6 && other <= 1.6;
    const double pitch = d.module * (d.teeth + 2 * out * d.profile_shift),
                 limit = pitch + outwards * out * 2 * kMost * d.module;
    source.reject(at, text("'", diameter_key, "' in [", label, "] = ", diameter * 1e3, ": with ", d.teeth,
                           " teeth, module_mm = ", d.module * 1e3, " and profile_shift = ", d.profile_shift,
                           " it must be between ", std::min(pitch, limit) * 1e3, " and ",
                           std::max(pitch, limit) * 1e3, " mm (", height_key, " above 0, at most 3)",
                           other_sign ? "; " + other_sign_words(-d.profile_shift) : ""));
  };
  take("tip_diameter_mm", "addendum", values.words.tip_diameter, d.addendum, 1);
  take("root_diameter_mm", "dedendum", values.words.root_diameter, d.dedendum, -1);
}

// The name of a gear that is misspelt in [gear.<name>.modification] is that of a gear which has nothing else.
void reject_stray_section(const Source& source, const std::string& name, const toml::table& table,
                          std::vector<std::string> names) {
  if (table.empty() ||
      !std::all_of(table.begin(), table.end(), [](const auto& entry) { return entry.second.is_table(); }))
    return;
  std::erase(names, name);
  source.reject(*table.begin()->second.as_table(),
                text("[gear.", name, ".", table.begin()->first.str(), "]: there is no [gear.", name,
                     "] with teeth", advice_for(name, names)));
}

// A gear has a folder beside those of results, which is a link to its body: what is made in a folder of its name would land there.
void reject_place(const Source& source, const std::string& name, const toml::table& table) {
  if (is_folder_of_results(name))
    source.reject(table, text("[gear.", name, "]: a gear cannot be called '", name,
                              "', a folder of results is; choose another name"));
  if (name.size() > kLongestName)
    source.reject(table, text("[gear.", name.substr(0, 40), "...]: its name has ", name.size(),
                              " letters; it becomes a folder, so it may have ", kLongestName, " at most"));
}

}  // namespace

void read_gears(const Source& source, Scene& scene, bool rigid) {
  // What a rigid gear does without: it is drawn, and its mesh checked, with a face and a rim of its own.
  const std::set<std::string> optional =
      rigid ? std::set<std::string>{"material", "face_width_mm", "bore_radius_mm"} : std::set<std::string>{};
  const auto materials = named_sections(source, "material");
  std::map<std::string, Material> material;
  for (const auto& [name, table] : materials) {
    const SectionReader reader(source, Dialect::scene, *table, "material", "material." + name);
    reader.reject_unknown();
    reader.read(keys(material[name]));
  }

  const auto gears = named_sections(source, "gear");
  const auto table_of = [&](const std::string& name) -> const toml::table* {
    for (const auto& gear : gears) {
      if (gear.first == name) return gear.second;
    }
    return nullptr;
  };
  const auto names = section_names(gears);
  for (const auto& [name, table] : gears) {
    reject_place(source, name, *table);
    reject_stray_section(source, name, *table, names);
    const SectionReader reader(source, Dialect::scene, *table, "gear", "gear." + name);
    std::vector<std::string> others{"crack", "modification", "error"};
    if (rigid) others.push_back("equivalent_mass_kg");
    reader.reject_unknown(others);
    GearValues values;
    GearDesign base_design;
    const toml::node* like = table->get("like");
    const toml::table* model = nullptr;
    if (like && like->is_string()) {
      const std::string base = like->value<std::string>().value_or("");
      model = table_of(base);
      if (base == name) source.reject(*like, text("[gear.", name, "] is like itself"));
      if (!model)
        source.reject(
            *like, text("'like' in [gear.", name, "] names no gear: '", base, "'", advice_for(base, names)));
      if (const toml::node* chain = model->get("like")) {
        source.reject(*like, text("[gear.", name, "] is like [gear.", base, "], which is like ",
                                  as_written(*chain), " itself; name the first gear"));
      }
      SectionReader(source, Dialect::scene, *model, "gear", "gear." + base)
          .read(gear_keys(values, says_internal(*model, false)), false, optional);
      take_diameters(source, *model, "gear." + base, nullptr, values);
      base_design = values.design;
      read_modification(source, *model, "gear." + base, values.modification);
    }
    reader.read(gear_keys(values, says_internal(*table, values.design.internal)), like != nullptr, optional);
    if (rigid)
      fill_blank(values.design);
    else
      require_blank(source, *table, "gear." + name, values.design);
    require_rim_support(source, *table, "gear." + name, rigid, values.design);
    take_diameters(source, *table, "gear." + name, like ? &base_design : nullptr, values);
    if (!table->contains("rack_tip_radius") && !(model && model->contains("rack_tip_radius")))
      values.design.rack_tip_radius = default_rack_tip_radius(values.design);
    read_modification(source, *table, "gear." + name, values.modification);
    read_errors(source, *table, "gear." + name, values);
    read_crack(source, *table, "gear." + name, values.design);
    if (rigid && values.words.material.empty()) {
      material[""] = {};
    } else if (!material.count(values.words.material)) {
      const toml::node* key = table->get("material");
      source.reject(key ? *key : static_cast<const toml::node&>(*table),
                    text("'material' in [gear.", name, "] = '", values.words.material,
                         "' names no [material.<name>] section",
                         advice_for(values.words.material, section_names(materials))));
    }
    scene.gears.push_back({name, values.design, material.at(values.words.material),
                           values.words.total_inertia, values.modification, values.errors});
  }
}

namespace {

void read_bearings(const Source& source, Scene& scene) {
  const toml::node* node = source.root().get("bearing");
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    source.reject(*node, "'bearing' must be a list of sections: write [[bearing]]");
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (const toml::node& item : *list) {
    const toml::table& table = *item.as_table();
    const SectionReader reader(source, Dialect::scene, table, "bearing", "bearing");
    reader.reject_unknown();
    std::string name;
    Bearing bearing;
    reader.read(bearing_gear_key(name).append(keys(bearing)));
    const auto gear = std::find(names.begin(), names.end(), name);
    if (gear == names.end())
      source.reject(*table.get("gear"), text("'gear' in [bearing] = '", name,
                                             "' names no [gear.<name>] section", advice_for(name, names)));
    Bearing& own = scene.gears[static_cast<std::size_t>(gear - names.begin())].bearing;
    if (own.elastic())
      source.reject(*table.get("gear"),
                    text("'gear' in [bearing] = '", name,
                         "' has a bearing already; give one section with what carries it in all"));
    own = bearing;
  }
}

void read_mesh_section(const Source& source, Scene& scene) {
  const toml::node* node = source.root().get("mesh");
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    source.reject(*node, "'mesh' must be a list of sections: write [[mesh]]");
  const toml::table& table = *list->get(0)->as_table();
  const SectionReader reader(source, Dialect::scene, table, "mesh", "mesh");
  reader.reject_unknown();
  GearMeshSpec& mesh = scene.mesh;
  reader.read(keys(mesh).section("mesh"));
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (int g = 0; g < kSides; ++g)
    if (const std::string& name = mesh.gear[g]; std::find(names.begin(), names.end(), name) == names.end())
      source.reject(*table.get(kRole[g]), text("'", kRole[g], "' in [mesh] = '", name,
                                               "' names no [gear.<name>] section", advice_for(name, names)));
  if (mesh.gear[0] == mesh.gear[1]) {
    source.reject(*table.get("driven"), text("'driven' in [mesh] = '", mesh.gear[1],
                                             "' is the driver, too; a gear cannot mesh with itself"));
  }
  for (int g = 0; g < kSides; ++g) {
    const SceneGear& own = scene.gear(mesh.gear[g]);
    mesh.modification[g] = own.modification;
    mesh.errors[g] = own.errors;
    mesh.bearing[g] = own.bearing;
  }
}

void read_friction(const Source& source, GearMeshSpec& mesh) {
  const toml::table* table = source.section("friction");
  if (!table) return;
  const SectionReader reader(source, Dialect::scene, *table, "friction", "friction");
  reader.reject_unknown();
  reader.read(keys(mesh.friction));
  const auto reject_key = [&](const char* key, const auto&... why) {
    const toml::node* at = table->get(key);
    source.reject(at ? *at : static_cast<const toml::node&>(*table),
                  text("'", key, "' in [friction] ", why...));
  };
  const bool constant = mesh.friction.law == FrictionLaw::constant;
  if (constant && !table->get("coefficient"))
    reject_key("coefficient",
               "is not given: law = \"constant\" requires it; give a number, 0.05 for example");
  if (!constant && table->get("coefficient"))
    reject_key("coefficient",
               "is given beside law = \"schlenk\", which computes it; take one of the two out");
  for (const auto& [key, value] : {std::pair{"viscosity_mPas", mesh.friction.viscosity},
                                   std::pair{"roughness_um", mesh.friction.roughness},
                                   std::pair{"lubricant_factor", mesh.friction.lubricant_factor},
                                   std::pair{"static_frequency_Hz", mesh.friction.static_frequency}}) {
    if (constant && table->get(key))
      reject_key(key, "has a meaning with law = \"schlenk\" only; take it out");
    if (!constant && !(value > 0))
      reject_key(key, "must be given and above 0: law = \"schlenk\" requires it");
  }
}

}  // namespace

bool is_system(const Source& source) {
  const toml::table& root = source.root();
  const toml::node* mesh = root.get("mesh");
  const toml::array* meshes = mesh ? mesh->as_array() : nullptr;
  return root.contains("carrier") || root.contains("drive") ||
         (meshes && meshes->is_array_of_tables() && meshes->size() > 1);
}

bool is_folder_of_results(const std::string& name) {
  static const std::set<std::string> others{"params", "report", "variants", "teeth", "up", "down"};
  const bool torque_like =
      name.size() > 1 && name[0] == 'T' && std::isdigit(static_cast<unsigned char>(name[1]));
  return others.contains(name) || torque_like;
}

bool plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

namespace {

Scene scene_from(const Source& source) {
  if (source.is_stage_parameters())
    source.reject(
        "holds stage parameters, which gear-scene wrote from a scene for one stage; give the scene itself");
  if (is_system(source)) {
    const toml::array* meshes = source.root()["mesh"].as_array();
    const std::string why = meshes && meshes->size() > 1
                                ? text("there are ", meshes->size(), " [[mesh]] sections, so it")
                                : std::string("it has [[carrier]] or [[drive]], so it");
    source.reject(text(
        why, " is the scene of a system, and this stage is for pairs; for systems there is make report"));
  }
  const SectionReader top(source, Dialect::scene, source.root(), "", "");
  top.reject_unknown({"gear", "material", "bearing", "mesh", "friction", "damping", "operation", "fidelity",
                      "discretisation"});
  std::vector<std::string> missing;
  for (const char* name : {"gear", "material", "mesh", "operation"}) {
    if (source.root().get(name)) continue;
    const std::string word(name);
    missing.push_back(word == "mesh"        ? "[[mesh]]"
                      : word == "operation" ? "[operation]"
                                            : "[" + word + ".<name>]");
  }
  if (!missing.empty()) source.reject(text("the scene lacks ", joined(missing), "; ", kExample));

  Scene scene;
  top.read(title_key(scene.title));
  if (scene.title.empty()) scene.title = std::filesystem::path(source.path()).stem().string();
  read_gears(source, scene, false);
  read_bearings(source, scene);
  read_mesh_section(source, scene);
  read_friction(source, scene.mesh);
  const KeyList rest = keys(scene.damping)
                           .append(keys(scene.operation))
                           .append(keys(scene.fidelity))
                           .append(keys(scene.body))
                           .append(keys(scene.contact))
                           .append(keys(scene.time));
  static const toml::table kNothing;
  for (const char* name : {"damping", "operation", "fidelity", "discretisation"}) {
    const toml::table* table = source.section(name);
    const SectionReader reader(source, Dialect::scene, table ? *table : kNothing, name, name);
    reader.reject_unknown();
    reader.read(rest.section(name));
    const toml::node* depth = table ? table->get("matching_depth_mm") : nullptr;
    if (depth && scene.body.near_field != NearField::matching)
      source.reject_value("matching_depth_mm", *depth,
                          text("'matching_depth_mm' in [", name, "] = ", as_written(*depth),
                               ": near_field is \"", scene.body.near_field,
                               "\", which has no depth; set near_field = \"matching\" or take it out"));
  }
  take_module(keys(scene.damping), scene.gear(scene.mesh.gear[0]).design.module);
  if (scene.fidelity.body == BodyModel::full) scene.body.modes = kAllModes;
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path) {
  return scene_from(Source(path));
}

Scene read_variant_of(const std::string& path, const std::string& variant) {
  return scene_from(Source(path, variant, false));
}

}  // namespace whine
