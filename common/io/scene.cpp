#include "io/scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "gear/face_width.h"
#include "gear/handbook_sign.h"
#include "gear/rack_tip.h"
#include "io/keys.h"
#include "io/scene_sections.h"
#include "io/section_reader.h"
#include "io/suggestion.h"
#include "io/variant.h"
#include "model/capabilities.h"

namespace whine {
namespace {

const char* const kExample = "data/scenes/first-pair.toml explains a whole scene line by line";

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
  }
}

void read_bearings(const Source& source, const std::vector<std::pair<std::string, Bearing*>>& of,
                   const std::string& unknown,
                   const std::function<void(const SectionReader&, const Bearing&, size_t)>& check) {
  for (const toml::table* table : source.list("bearing")) {
    std::string name;
    Bearing bearing;
    const SectionReader reader(source, *table, "bearing", "bearing");
    reader.read_all(bearing_gear_key(name).append(keys(bearing)));
    std::vector<std::string> names;
    names.reserve(of.size());
    for (const auto& [own, held] : of) names.push_back(own);
    const auto at = static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (at == names.size())
      reader.reject_key("gear", " = '", name, "' names no ", unknown, advice_for(name, names));
    if (of[at].second->elastic())
      reader.reject_key("gear", " = '", name,
                        "' has a bearing already; give one section with what carries it in all");
    check(reader, bearing, at);
    *of[at].second = bearing;
  }
}

void read_levels(const Source& source, const KeyList& keys,
                 const std::function<void(const SectionReader&)>& check) {
  static const toml::table kNothing;
  for (const char* name : {"fidelity", "discretisation", "damping", "operation", "accuracy"}) {
    const toml::table* table = source.section(name);
    const SectionReader reader(source, table ? *table : kNothing, name, name);
    check(reader);
    reader.read_all(keys.section(name));
  }
}

KeyGiven keys_given(const Source& source) {
  return [&source](const std::string& key) {
    for (const char* section : {"fidelity.", "discretisation."})
      if (source.root().at_path(section + key).node()) return true;
    return false;
  };
}

namespace {

void read_mesh_section(const Source& source, Scene& scene) {
  const toml::table& table = *source.list("mesh")[0];
  const SectionReader reader(source, table, "mesh", "mesh");
  GearMeshSpec& mesh = scene.mesh;
  reader.read_all(keys(mesh).section("mesh"));
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (int g = 0; g < kSides; ++g)
    if (const std::string& name = mesh.gear[g]; std::find(names.begin(), names.end(), name) == names.end())
      reader.reject_key(kRole[g], " = '", name, "' names no [gear.<name>] section", advice_for(name, names));
  if (mesh.gear[0] == mesh.gear[1])
    reader.reject_key("driven", " = '", mesh.gear[1], "' is the driver, too; a gear cannot mesh with itself");
  for (int g = 0; g < kSides; ++g) {
    const SceneGear& own = scene.gear(mesh.gear[g]);
    mesh.modification[g] = own.modification;
    mesh.errors[g] = own.errors;
    mesh.bearing[g] = own.bearing;
  }
}

}  // namespace

void read_friction(const Source& source, Friction& friction) {
  const toml::table* table = source.section("friction");
  if (!table) return;
  const SectionReader reader(source, *table, "friction", "friction");
  reader.read_all(keys(friction));
  const bool constant = friction.law == FrictionLaw::constant, given = reader.node("coefficient");
  if (constant && !given)
    reader.reject_key("coefficient",
                      " is not given: law = \"constant\" requires it; give a number, 0.05 for example");
  if (!constant && given)
    reader.reject_key("coefficient",
                      " is given beside law = \"schlenk\", which computes it; take one of the two out");
  for (const auto& [key, value] :
       {std::pair{"viscosity_mPas", friction.viscosity}, std::pair{"roughness_um", friction.roughness},
        std::pair{"lubricant_factor", friction.lubricant_factor},
        std::pair{"static_frequency_Hz", friction.static_frequency}}) {
    if (constant && reader.node(key))
      reader.reject_key(key, " has a meaning with law = \"schlenk\" only; take it out");
    if (!constant && !(value > 0))
      reader.reject_key(key, " must be given and above 0: law = \"schlenk\" requires it");
  }
}

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

// Level over the face and degree where the scene leaves them open: bodies in three dimensions for what one slice does not hold.
void take_width(const Source& source, Scene& scene) {
  const GearDesign &driver = scene.gear(scene.mesh.gear[0]).design,
                   &driven = scene.gear(scene.mesh.gear[1]).design;
  if (!source.root().at_path("fidelity.width").node() && !face_words(scene.mesh, driver, driven).empty())
    scene.fidelity.width = WidthModel::body;
  int& degree = scene.body.width.degree;
  if (scene.fidelity.width == WidthModel::body && degree == 0) degree = degree_of_width(driver, driven);
}

Scene scene_from(const Source& source) {
  if (source.is_stage_parameters())
    source.reject(
        "holds stage parameters, which gear-scene wrote from a scene for one stage; give the scene itself");
  if (is_system(source)) {
    const toml::array* meshes = source.root()["mesh"].as_array();
    const std::string why = meshes && meshes->size() > 1
                                ? text("there are ", meshes->size(), " [[mesh]] sections, so it")
                                : std::string("it has [[carrier]] or [[drive]], so it");
    source.reject(why,
                  " is the scene of a system, and this stage is for pairs; for systems there is make report");
  }
  const SectionReader top(source, source.root(), "", "");
  top.reject_unknown({"gear", "material", "bearing", "mesh", "friction", "damping", "operation", "fidelity",
                      "discretisation", "accuracy"});
  std::vector<std::string> missing;
  for (const char* name : {"gear", "material", "mesh", "operation"}) {
    if (source.root().get(name)) continue;
    const std::string word(name);
    missing.push_back(word == "mesh"        ? "[[mesh]]"
                      : word == "operation" ? "[operation]"
                                            : "[" + word + ".<name>]");
  }
  if (!missing.empty()) source.reject("the scene lacks ", joined(missing), "; ", kExample);

  Scene scene;
  top.read(title_key(scene.title));
  if (scene.title.empty()) scene.title = std::filesystem::path(source.path()).stem().string();
  read_gears(source, scene, false);
  std::vector<std::pair<std::string, Bearing*>> hubs;
  for (SceneGear& gear : scene.gears) hubs.emplace_back(gear.name, &gear.bearing);
  read_bearings(source, hubs, "[gear.<name>] section");
  read_mesh_section(source, scene);
  read_friction(source, scene.mesh.friction);
  read_levels(source, keys(scene.damping)
                          .append(keys(scene.operation))
                          .append(keys(scene.fidelity))
                          .append(keys(scene.body))
                          .append(keys(scene.body.width))
                          .append(keys(scene.contact))
                          .append(keys(scene.time)));
  const toml::node* depth = source.root().at_path("discretisation.matching_depth_mm").node();
  if (depth && scene.body.near_field != NearField::matching)
    source.reject_value("matching_depth_mm", *depth,
                        "'matching_depth_mm' in [discretisation] = ", as_written(*depth),
                        ": near_field is \"", scene.body.near_field,
                        "\", which has no depth; set near_field = \"matching\" or take it out");
  take_module(keys(scene.damping), scene.gear(scene.mesh.gear[0]).design.module);
  if (scene.fidelity.body == BodyModel::full) scene.body.modes = kAllModes;
  take_width(source, scene);
  take_accuracy(source, scene);
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
