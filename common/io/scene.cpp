#include "io/scene.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "gear/accuracy.h"
#include "gear/face_width.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/keys.h"
#include "io/scene_sections.h"
#include "io/suggestion.h"
#include "io/variant.h"
#include "model/capabilities.h"
#include "system/system_rest.h"

namespace whine {

std::string advice_for(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? text("; known are: ", joined(known)) : text("; did you mean '", near, "'?");
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

// The hunting period is checked at the last gear with errors or a crack, which makes it as long as it is.
void check_hunting(const Source& source, const Scene& gears) {
  std::vector<int> teeth;
  for (const SceneGear& own : gears.gears) {
    if (!own.teeth_differ()) continue;
    teeth.push_back(own.design.teeth);
    try {
      hunting_periods_of(teeth);
    } catch (const Error& error) {
      const toml::table& table = *source.section("gear")->get(own.name)->as_table();
      const char* const section = own.errors.none() ? "crack" : "error";
      source.reject(*table.get(section), "[gear.", own.name, ".", section, "]: ", error.what());
    }
  }
}

void take_carriers(const Source& source, Scene& scene, bool rigid) {
  for (const toml::table* table : source.list("carrier")) {
    Scene::Carrier& carrier = scene.carriers.emplace_back();
    const SectionReader reader(source, *table, "carrier", "carrier");
    reader.read_all(keys(carrier));
    if (!plain_name(carrier.name))
      reader.reject_key("name", " = '", carrier.name, "': a name holds letters, digits, '_' and '-' only");
    const bool one = carrier.inertia > 0, other = carrier.equivalent_mass > 0;
    if (one && other)
      reader.reject(" '", carrier.name,
                    "' gives 'inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them");
    if (rigid && !one && !other)
      reader.reject(" '", carrier.name, "' needs its inertia, either 'inertia_kgm2' or 'equivalent_mass_kg'");
  }
}

void take_pins(const Source& source, Scene& scene, bool rigid) {
  for (const toml::table* table : source.list("pin")) {
    const SectionReader reader(source, *table, "pin", "pin");
    reader.read_all(keys(scene.pins.emplace_back()));
    if (rigid)
      reader.reject(
          " belongs to elastic gears: natural modes of rigid ones do not depend on where pins stand by micrometres; take it out");
  }
}

// What body = "rigid" needs and elastic gears cannot have: `computed` of them.
void reject_stiffness(const SectionReader& section, bool rigid, const char* computed) {
  if (const toml::node* node = section.node("stiffness_N_um"); node && !rigid)
    section.reject_key("stiffness_N_um", " belongs to body = \"rigid\"; ", computed, ", take it out");
}

void take_meshes(const Source& source, Scene& scene, bool train, bool rigid) {
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (const toml::table* table : source.list("mesh")) {
    Scene::Mesh& mesh = scene.meshes.emplace_back();
    GearMeshSpec& spec = mesh.spec;
    const SectionReader reader(source, *table, "mesh", "mesh");
    reader.reject_unknown(train ? std::vector<std::string>{"direction_deg", "stiffness_N_um"}
                                : std::vector<std::string>{});
    reader.read(keys(spec).section("mesh"));
    for (int g = 0; g < kSides; ++g)
      if (std::find(names.begin(), names.end(), spec.gear[g]) == names.end())
        reader.reject_key(kRole[g], " = '", spec.gear[g], "' names no [gear.<name>] section",
                          advice_for(spec.gear[g], names));
    if (spec.gear[0] == spec.gear[1])
      reader.reject_key("driven", " = '", spec.gear[1],
                        "' is the driver, too; a gear cannot mesh with itself");
    for (int g = 0; g < kSides; ++g) spec.modification[g] = scene.gear(spec.gear[g]).modification;
    if (!train) continue;
    reader.read(keys(mesh));
    reject_stiffness(reader, rigid, "that of elastic gears is computed");
    reader.reject_given(
        "face_offset_mm",
        ", and in a train the middles of all faces stand in one plane, on which the phases of helical meshes depend; take the line out");
    if (rigid && !(mesh.stiffness > 0))
      reader.reject(" of '", spec.gear[0], "' and '", spec.gear[1],
                    "' lacks 'stiffness_N_um', which body = \"rigid\" needs");
  }
}

void take_bearings(const Source& source, Scene& scene, bool train, bool rigid) {
  std::vector<std::string> names;
  std::vector<Bearing*> hubs;
  const auto add = [&](auto& bodies) {
    for (auto& body : bodies) {
      names.push_back(body.name);
      hubs.push_back(&body.bearing);
    }
  };
  add(scene.gears);
  add(scene.carriers);
  for (const toml::table* table : source.list("bearing")) {
    std::string name;
    Bearing bearing;
    const SectionReader reader(source, *table, "bearing", "bearing");
    reader.read_all(bearing_gear_key(name).append(keys(bearing)));
    const auto at = static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (at == names.size())
      reader.reject_key("gear", " = '", name, "' names no ",
                        train ? "gear and no carrier" : "[gear.<name>] section", advice_for(name, names));
    if (hubs[at]->elastic())
      reader.reject_key("gear", " = '", name,
                        "' has a bearing already; give one section with what carries it in all");
    if ((rigid || at >= scene.gears.size()) && !(bearing.mass > 0))
      reader.reject(" of '", name, "' lacks 'mass_kg', which ", rigid ? "body = \"rigid\"" : "a carrier",
                    " needs");
    *hubs[at] = bearing;
  }
}

// [friction] is that of all meshes.
void take_friction(const Source& source, Scene& scene, bool rigid) {
  const toml::table* table = source.section("friction");
  if (!table) return;
  if (rigid)
    source.reject(*table,
                  "[friction] belongs to elastic gears, and those of this scene are rigid; take it out");
  Friction friction;
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
  for (Scene::Mesh& mesh : scene.meshes) mesh.spec.friction = friction;
}

void take_drives(const Source& source, Scene& scene, bool rigid) {
  for (const toml::table* table : source.list("drive")) {
    Scene::Drive& drive = scene.drives.emplace_back();
    const SectionReader reader(source, *table, "drive", "drive");
    reader.read_all(keys(drive));
    for (const auto& [key, kind] : {std::pair{"torque_Nm", System::DriveKind::torque},
                                    std::pair{"stiffness_N_um", System::DriveKind::held}})
      if (reader.node(key) && drive.kind != kind)
        reader.reject_key(key, " belongs to kind = \"", kind, "\", and this drive is of kind \"", drive.kind,
                          "\"");
    reject_stiffness(reader, rigid, "elastic gears are held rigidly");
  }
}

// [fidelity], [discretisation], [damping], [operation] and [accuracy], each of which may be left out.
void take_levels(const Source& source, Scene& scene, bool train) {
  const bool moves = source.root().get("operation") != nullptr;
  const size_t meshes = source.list("mesh").size();
  Operation& speeds = scene.operation;
  KeyList all = keys(scene.fidelity)
                    .append(keys(scene.body))
                    .append(keys(scene.contact))
                    .append(keys(scene.damping))
                    .append(keys(scene.time));
  if (!train) all.append(keys(scene.body.width)).append(keys(speeds));
  if (train && moves) all.append(speeds_key(speeds));
  if (const toml::node* node = source.root().at_path("operation.torque_Nm").node(); node && train)
    source.reject(*node, "'torque_Nm' in [operation] is of pairs, and this scene has ",
                  meshes > 1 ? text(meshes, " [[mesh]] sections") : "[[carrier]] or [[drive]]",
                  ": the torques of a system are those of [[drive]]; take it out");
  static const toml::table kNothing;
  for (const char* name : {"fidelity", "discretisation", "damping", "operation", "accuracy"}) {
    const toml::table* table = source.section(name);
    const SectionReader section(source, table ? *table : kNothing, name, name);
    if (table && train && scene.fidelity.body == BodyModel::rigid && name != std::string("fidelity"))
      section.reject(" belongs to elastic gears", name == std::string("discretisation") ? "" : " in motion",
                     ", and those of this scene are rigid; take it out");
    section.read_all(all.section(name));
  }
  if (const std::string words = refusal("motion", traits(scene.fidelity));
      train && moves && scene.fidelity.body != BodyModel::rigid && !words.empty()) {
    const toml::node* node = source.root().at_path("fidelity.body").node();
    source.reject(node ? *node : source.root(), words, ", or take [operation] out");
  }
  const toml::node* depth = source.root().at_path("discretisation.matching_depth_mm").node();
  if (depth && scene.body.near_field != NearField::matching)
    source.reject_value("matching_depth_mm", *depth,
                        "'matching_depth_mm' in [discretisation] = ", as_written(*depth),
                        ": near_field is \"", scene.body.near_field,
                        "\", which has no depth; set near_field = \"matching\" or take it out");
  if (scene.fidelity.body == BodyModel::full) scene.body.modes = kAllModes;
}

// Level over the face: slices where a mesh is more than one slice and the scene leaves it open.
void take_width_of_train(const Source& source, Scene& scene) {
  std::string words;
  for (const GearMeshSpec& mesh : scene.specs())
    if (words.empty())
      words = face_words(mesh, scene.gear(mesh.gear[0]).design, scene.gear(mesh.gear[1]).design);
  const toml::node* level = source.root().at_path("fidelity.width").node();
  if (!level && !words.empty()) scene.fidelity.width = WidthModel::slices;
  const toml::node& at = level ? *level : source.root();
  if (scene.fidelity.width == WidthModel::one) {
    if (!words.empty())
      source.reject(at, "width = \"one\" in [fidelity], and ", words,
                    ": one slice over the face is of spur gears under even load; write width = \"slices\"");
    scene.contact.face_points = 0;
    return;
  }
  if (scene.rigid())
    source.reject(at, level ? text("width = \"", scene.fidelity.width, "\" in [fidelity]") : words,
                  ", and the gears of this scene are rigid, whose meshes are springs of stiffness_N_um; ",
                  level ? "take the line out" : "give spur gears, or elastic ones");
  const auto refuse = [&](const std::string& path, Trait trait, const std::string& where) {
    const toml::node* node = source.root().at_path(path).node();
    if (const std::string why = refusal("width", {{trait, where}}); !why.empty())
      source.reject(node ? *node : at, why);
  };
  if (scene.fidelity.width == WidthModel::body)
    refuse("fidelity.width", Trait::train_of_bodies, "width = \"body\" in [fidelity]");
  scene.fidelity.contact = ContactModel::line;
  const std::string of = text(" with width = \"slices\"", words.empty() ? "" : ", " + words);
  if (scene.meshes[0].spec.friction.acts()) refuse("friction", Trait::friction, "[friction]" + of);
  for (const SceneGear& gear : scene.gears) {
    const std::string path = "gear." + gear.name;
    if (gear.design.crack.depth > 0) refuse(path + ".crack", Trait::cracked, "[" + path + ".crack]" + of);
    if (!gear.errors.none()) refuse(path + ".error", Trait::differing, "[" + path + ".error]" + of);
    if (gear.design.helical() && gear.material.plane_stress)
      refuse(path + ".helix_angle_deg", Trait::plane_stress, "[" + path + "] is helical, plane = \"stress\"");
  }
}

// Level over the face and degree where the scene of a pair leaves them open: bodies in three dimensions for what one slice does not hold.
void take_width_of_pair(const Source& source, Scene& scene) {
  const GearMeshSpec& mesh = scene.mesh();
  const GearDesign &driver = scene.gear(mesh.gear[0]).design, &driven = scene.gear(mesh.gear[1]).design;
  if (!source.root().at_path("fidelity.width").node() && !face_words(mesh, driver, driven).empty())
    scene.fidelity.width = WidthModel::body;
  int& degree = scene.body.width.degree;
  if (scene.fidelity.width == WidthModel::body && degree == 0) degree = degree_of_width(driver, driven);
  if (scene.fidelity.width == WidthModel::one) scene.contact.face_points = 0;
}

// Names of gears that share a shaft come first: what else a scene of them lacks leads nowhere.
void require_one_train(const Source& source) {
  const std::vector<const toml::table*> tables = source.list("mesh");
  const toml::table* gears = source.root()["gear"].as_table();
  std::vector<std::array<std::string, 2>> meshes;
  for (const toml::table* table : tables) {
    meshes.push_back(
        {(*table)["driver"].value_or(std::string()), (*table)["driven"].value_or(std::string())});
    for (const std::string& name : meshes.back())
      if (!gears || !gears->contains(name)) return;  // said where they are read
  }
  try {
    require_joined(meshes);
  } catch (const SectionError& error) {
    source.reject(*tables[error.number()], error.what());
  }
}

// Several meshes, or a list of what pairs have none of.
bool is_system(const Source& source) {
  const auto lists = [&](const char* name, size_t least) {
    const toml::array* list = source.root()[name].as_array();
    return list ? list->size() >= least : least == 1 && source.root().contains(name);
  };
  return lists("carrier", 1) || lists("drive", 1) || lists("mesh", 2);
}

void require_sections(const Source& source, const SectionReader& top, bool train) {
  std::vector<std::string> known{"gear",    "material",  "bearing",  "mesh",           "friction",
                                 "damping", "operation", "fidelity", "discretisation", "accuracy"};
  if (train) known.insert(known.end(), {"carrier", "pin", "drive"});
  top.reject_unknown(known);
  std::vector<std::string> missing;
  for (const std::string name : {"gear", "material", "mesh", "operation"})
    if (!source.root().get(name) && (!train || name == "gear" || name == "mesh"))
      missing.push_back(name == "mesh"        ? "[[mesh]]"
                        : name == "operation" ? "[operation]"
                                              : "[" + name + ".<name>]");
  if (!missing.empty())
    source.reject("the scene lacks ", joined(missing), "; data/scenes/",
                  train ? "lin-parker-planetary.toml is an example"
                        : "first-pair.toml explains a whole scene line by line");
}

// What [accuracy] asks for, see gear/accuracy.h; its errors at the key.
void take_accuracy(const Source& source, Scene& scene) {
  const toml::node* asked = source.root().at_path("accuracy.rms_percent").node();
  if (!asked) return choose_by_default(scene, keys_given(source));
  try {
    choose_discretisation(scene, keys_given(source));
  } catch (const Error& error) {
    source.reject_value("rms_percent", *asked, error.what());
  }
}

Scene scene_from(const Source& source) {
  if (source.is_stage_parameters())
    source.reject(
        "holds stage parameters, which gear-scene wrote from a scene for one stage; give the scene itself");
  const bool train = is_system(source);
  if (train) require_one_train(source);
  const SectionReader top(source, source.root(), "", "");
  require_sections(source, top, train);
  Scene scene;
  top.read(title_key(scene.title));
  if (scene.title.empty()) scene.title = std::filesystem::path(source.path()).stem().string();
  take_levels(source, scene, train);
  const bool rigid = train && scene.fidelity.body == BodyModel::rigid;
  read_gears(source, scene, rigid);
  if (train) check_hunting(source, scene);
  take_carriers(source, scene, rigid);
  take_pins(source, scene, rigid);
  take_meshes(source, scene, train, rigid);
  take_friction(source, scene, rigid);
  take_bearings(source, scene, train, rigid);
  take_drives(source, scene, rigid);
  double module = 0;
  for (const SceneGear& gear : scene.gears) module = std::max(module, gear.design.module);
  take_module(keys(scene.damping), train ? module : scene.gear(scene.mesh().gear[0]).design.module);
  if (train) {
    take_width_of_train(source, scene);
  } else {
    for (int g = 0; g < kSides; ++g) {
      const SceneGear& gear = scene.gear(scene.mesh().gear[g]);
      scene.mesh().errors[g] = gear.errors;
      scene.mesh().bearing[g] = gear.bearing;
    }
    take_width_of_pair(source, scene);
  }
  if (!rigid) take_accuracy(source, scene);
  return scene;
}

}  // namespace

KeyGiven keys_given(const Source& source) {
  return [&source](const std::string& key) {
    for (const char* section : {"fidelity.", "discretisation."})
      if (source.root().at_path(section + key).node()) return true;
    return false;
  };
}

bool is_system_scene(const std::string& path) {
  try {
    return is_system(Source(path));
  } catch (const Error&) {
    return false;
  }
}

Scene read_scene(const std::string& path) {
  return scene_from(Source(path));
}

Scene read_pair_scene(const std::string& path) {
  Scene scene = read_scene(path);
  if (!scene.pair())
    fail(Failure::input, path,
         ": is the scene of a train, and this stage is for pairs; for trains there is make report");
  return scene;
}

Scene read_variant_of(const std::string& path, const std::string& variant) {
  return scene_from(Source(path, variant, false));
}

namespace {

// What `make` gives; its SectionError with file and line.
template <class Make>
auto placed_in(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const SectionError& error) {
    const Source source(path);
    const auto tables = source.list(error.section());
    if (error.number() < tables.size()) source.reject(*tables[error.number()], error.what());
    source.reject(error.what());
  }
}

}  // namespace

std::vector<std::string> motion_remarks(const Scene& scene) {
  std::vector<std::string> out;
  if (scene.pair() || scene.rigid() || !(scene.operation.frequency_to > 0)) return out;
  if (scene.fidelity.contact != ContactModel::line)
    out.push_back(text("note: contact = \"", scene.fidelity.contact,
                       "\" is that of the statics; in motion a system has contact = \"line\""));
  if (scene.damping.rayleigh_stiffness == kDefaultRayleighStiffness &&
      scene.fidelity.body != BodyModel::quasi_static)
    out.push_back(text(
        "warning: rayleigh_stiffness_s = ", scene.damping.rayleigh_stiffness,
        ", the default, is for the gears of P2000; `make SCENE=path/to/scene.toml impact` shows the damping ratios that it gives these, write your own into [damping]"));
  return out;
}

System layout_in(const Scene& scene, const std::string& path) {
  if (scene.pair()) return {};
  return placed_in(path, [&] { return layout_of(scene); });
}

void check_at_rest_in(const Scene& scene, const System& layout, const std::string& path) {
  placed_in(path, [&] { check_at_rest(scene, layout); });
}

}  // namespace whine
