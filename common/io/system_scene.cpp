#include "io/system_scene.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/scene_sections.h"
#include "io/variant.h"
#include "model/capabilities.h"
#include "system/system_rest.h"

namespace whine {
namespace {

// What a gear of a system cannot have.
void reject_sections(const SectionReader& gear, bool rigid) {
  for (const char* key : {"modification", "error", "crack"}) {
    const toml::node* node = gear.node(key);
    if (node && rigid)
      gear.source().reject(*node, "[", gear.label(), ".", key,
                           "]: a gear of a system with body = \"rigid\" has no '", key,
                           "', its mesh is one spring of stiffness_N_um; take the section out");
  }
}

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

void take_gears(const Source& source, SystemScene& scene) {
  Scene gears;
  const bool rigid = scene.rigid();
  read_gears(source, gears, rigid);
  check_hunting(source, gears);
  const toml::table& tables = *source.section("gear");
  const auto reader_of = [&](const std::string& name) {
    return SectionReader(source, *tables.get(name)->as_table(), "rigid_gear", "gear." + name);
  };
  for (const SceneGear& own : gears.gears) {
    SystemScene::Gear& gear = scene.gears.emplace_back();
    static_cast<SceneGear&>(gear) = own;
    const SectionReader reader = reader_of(own.name);
    reject_sections(reader, rigid);
    if (!rigid) continue;
    const auto like = reader.table()["like"].value<std::string>();
    const bool inherits = like && !reader.node("equivalent_mass_kg");
    SectionReader(source, inherits ? reader_of(*like).table() : reader.table(), "rigid_gear", reader.label())
        .read(equivalent_mass_key(gear.equivalent_mass));
    if (gear.equivalent_mass > 0 && gear.total_inertia > 0)
      reader.reject(
          " gives 'total_inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them");
    if (!(gear.equivalent_mass > 0 || gear.total_inertia > 0))
      reader.reject(
          " of a system with body = \"rigid\" lacks its inertia: give 'total_inertia_kgm2' or 'equivalent_mass_kg'");
  }
}

void take_carriers(const Source& source, SystemScene& scene) {
  for (const toml::table* table : source.list("carrier")) {
    SystemScene::Carrier& carrier = scene.carriers.emplace_back();
    const SectionReader reader(source, *table, "carrier", "carrier");
    reader.read_all(keys(carrier));
    if (!plain_name(carrier.name))
      reader.reject_key("name", " = '", carrier.name, "': a name holds letters, digits, '_' and '-' only");
    const bool one = carrier.inertia > 0, other = carrier.equivalent_mass > 0;
    if (one && other)
      reader.reject(" '", carrier.name,
                    "' gives 'inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them");
    if (scene.rigid() && !one && !other)
      reader.reject(" '", carrier.name, "' needs its inertia, either 'inertia_kgm2' or 'equivalent_mass_kg'");
  }
}

void take_pins(const Source& source, SystemScene& scene) {
  for (const toml::table* table : source.list("pin")) {
    const SectionReader reader(source, *table, "pin", "pin");
    reader.read_all(keys(scene.pins.emplace_back()));
    if (scene.rigid())
      reader.reject(
          " belongs to elastic gears: natural modes of rigid ones do not depend on where pins stand by micrometres; take it out");
  }
}

// What body = "rigid" needs and elastic gears cannot have: `computed` of them.
void reject_stiffness(const SectionReader& section, bool rigid, const char* computed) {
  if (const toml::node* node = section.node("stiffness_N_um"); node && !rigid)
    section.reject_key("stiffness_N_um", " belongs to body = \"rigid\"; ", computed, ", take it out");
}

void take_meshes(const Source& source, SystemScene& scene) {
  for (const toml::table* table : source.list("mesh")) {
    SystemScene::Mesh& mesh = scene.meshes.emplace_back();
    const SectionReader reader(source, *table, "mesh", "mesh");
    reader.reject_unknown({"direction_deg", "stiffness_N_um"});
    reader.read(keys(mesh.spec).section("mesh"));
    reader.read(keys(mesh));
    reject_stiffness(reader, scene.rigid(), "that of elastic gears is computed");
    reader.reject_given(
        "face_offset_mm",
        ", and in a train the middles of all faces stand in one plane, on which the phases of helical meshes depend; take the line out");
    if (scene.rigid() && !(mesh.stiffness > 0))
      reader.reject(" of '", mesh.spec.gear[0], "' and '", mesh.spec.gear[1],
                    "' lacks 'stiffness_N_um', which body = \"rigid\" needs");
    for (size_t g = 0; g < kSides; ++g)
      for (const SystemScene::Gear& gear : scene.gears)
        if (gear.name == mesh.spec.gear[g]) mesh.spec.modification[g] = gear.modification;
  }
}

void take_bearings(const Source& source, SystemScene& scene) {
  std::vector<std::pair<std::string, Bearing*>> hubs;
  for (SystemScene::Gear& gear : scene.gears) hubs.emplace_back(gear.name, &gear.bearing);
  for (SystemScene::Carrier& carrier : scene.carriers) hubs.emplace_back(carrier.name, &carrier.bearing);
  read_bearings(source, hubs, "gear and no carrier",
                [&](const SectionReader& reader, const Bearing& bearing, size_t hub) {
                  const bool drawn = !scene.rigid() && hub < scene.gears.size();
                  if (!drawn && !(bearing.mass > 0))
                    reader.reject(" of '", hubs[hub].first, "' lacks 'mass_kg', which ",
                                  scene.rigid() ? "body = \"rigid\"" : "a carrier", " needs");
                });
}

// [friction] is that of all meshes.
void take_friction(const Source& source, SystemScene& scene) {
  const toml::node* node = source.root().get("friction");
  if (!node) return;
  if (scene.rigid())
    source.reject(*node,
                  "[friction] belongs to elastic gears, and those of this scene are rigid; take it out");
  Friction friction;
  read_friction(source, friction);
  for (SystemScene::Mesh& mesh : scene.meshes) mesh.spec.friction = friction;
}

void take_drives(const Source& source, SystemScene& scene) {
  for (const toml::table* table : source.list("drive")) {
    SystemScene::Drive& drive = scene.drives.emplace_back();
    const SectionReader reader(source, *table, "drive", "drive");
    reader.read_all(keys(drive));
    for (const auto& [key, kind] : {std::pair{"torque_Nm", System::DriveKind::torque},
                                    std::pair{"stiffness_N_um", System::DriveKind::held}})
      if (reader.node(key) && drive.kind != kind)
        reader.reject_key(key, " belongs to kind = \"", kind, "\", and this drive is of kind \"", drive.kind,
                          "\"");
    reject_stiffness(reader, scene.rigid(), "elastic gears are held rigidly");
  }
}

// [fidelity], [discretisation], [damping] and [operation].
void take_fidelity(const Source& source, SystemScene& scene) {
  if (const toml::node* node = source.root().at_path("operation.torque_Nm").node())
    source.reject(
        *node,
        "'torque_Nm' in [operation] is of pairs: the torques of a system are those of [[drive]]; take it out");
  const bool moves = source.root().get("operation") != nullptr;
  KeyList all = keys(scene.fidelity)
                    .append(keys(scene.body))
                    .append(keys(scene.contact))
                    .append(keys(scene.damping))
                    .append(keys(scene.time));
  Operation& speeds = scene.operation;
  if (moves) all.append(speeds_key(speeds.frequency_from, speeds.frequency_to, speeds.frequency_step));
  read_levels(source, all, [&](const SectionReader& section) {
    if (source.root().get(section.label()) && scene.rigid() &&
        (section.label() == "damping" || section.label() == "operation" || section.label() == "accuracy"))
      section.reject(" belongs to elastic gears in motion, and those of this scene are rigid; take it out");
  });
  if (const std::string words = refusal("motion", traits(scene.fidelity));
      moves && !scene.rigid() && !words.empty()) {
    const toml::node* node = source.root().at_path("fidelity.body").node();
    source.reject(node ? *node : source.root(), words, ", or take [operation] out");
  }
  if (const toml::node* node = source.root().get("discretisation"); node && scene.rigid())
    source.reject(
        *node, "[discretisation] belongs to elastic gears, and those of this scene are rigid; take it out");
  if (scene.fidelity.body == BodyModel::full) scene.body.modes = kAllModes;
}

// Level over the face: slices where a mesh is more than one slice and the scene leaves it open.
void take_width(const Source& source, SystemScene& scene) {
  std::string words;
  for (const SystemScene::Mesh& mesh : scene.meshes) {
    std::array<const GearDesign*, kSides> design{};
    for (size_t g = 0; g < kSides; ++g)
      for (const SystemScene::Gear& gear : scene.gears)
        if (gear.name == mesh.spec.gear[g]) design[g] = &gear.design;
    if (words.empty() && design[0] && design[1]) words = face_words(mesh.spec, *design[0], *design[1]);
  }
  const toml::node* level = source.root().at_path("fidelity.width").node();
  if (!level && !words.empty()) scene.fidelity.width = WidthModel::slices;
  const toml::node& at = level ? *level : source.root();
  if (scene.fidelity.width == WidthModel::one) {
    if (!words.empty())
      source.reject(at, "width = \"one\" in [fidelity], and ", words,
                    ": one slice over the face is of spur gears under even load; write width = \"slices\"");
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
  for (const SystemScene::Gear& gear : scene.gears) {
    const std::string path = "gear." + gear.name;
    if (gear.design.crack.depth > 0) refuse(path + ".crack", Trait::cracked, "[" + path + ".crack]" + of);
    if (!gear.errors.none()) refuse(path + ".error", Trait::differing, "[" + path + ".error]" + of);
    if (gear.design.helical() && gear.material.plane_stress)
      refuse(path + ".helix_angle_deg", Trait::plane_stress, "[" + path + "] is helical, plane = \"stress\"");
  }
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
  } catch (const SystemSceneError& error) {
    source.reject(*tables[error.number()], error.what());
  }
}

}  // namespace

bool is_system_scene(const std::string& path) {
  try {
    return is_system(Source(path));
  } catch (const Error&) {
    return false;
  }
}

namespace {

SystemScene system_scene_from(const Source& source) {
  if (source.is_stage_parameters())
    source.reject("holds stage parameters, which gear-scene wrote from a scene; give the scene itself");
  require_one_train(source);
  const SectionReader top(source, source.root(), "", "");
  top.reject_unknown({"gear", "material", "bearing", "mesh", "carrier", "pin", "drive", "friction", "damping",
                      "operation", "fidelity", "discretisation", "accuracy"});
  for (const char* name : {"gear", "mesh"})
    if (!source.root().get(name))
      source.reject("the scene of a system lacks ",
                    name == std::string("gear") ? "[gear.<name>]" : "[[mesh]]",
                    "; data/scenes/lin-parker-planetary.toml is an example");
  SystemScene scene;
  top.read(title_key(scene.title));
  if (scene.title.empty()) scene.title = std::filesystem::path(source.path()).stem().string();
  take_fidelity(source, scene);
  take_gears(source, scene);
  double largest = 0;
  for (const SystemScene::Gear& gear : scene.gears) largest = std::max(largest, gear.design.module);
  take_module(keys(scene.damping), largest);
  take_carriers(source, scene);
  take_pins(source, scene);
  take_meshes(source, scene);
  take_friction(source, scene);
  take_width(source, scene);
  take_bearings(source, scene);
  take_drives(source, scene);
  if (!scene.rigid()) take_accuracy(source, scene);
  return scene;
}

}  // namespace

SystemScene read_system_scene(const std::string& path) {
  return system_scene_from(Source(path));
}

SystemScene read_system_variant_of(const std::string& path, const std::string& variant) {
  return system_scene_from(Source(path, variant, false));
}

namespace {

// What `make` gives; its SystemSceneError with file and line.
template <class Make>
auto placed_in(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const SystemSceneError& error) {
    const Source source(path);
    const auto tables = source.list(error.section());
    if (error.number() < tables.size()) source.reject(*tables[error.number()], error.what());
    source.reject(error.what());
  }
}

}  // namespace

std::vector<std::string> motion_remarks(const SystemScene& scene) {
  std::vector<std::string> out;
  if (scene.rigid() || !(scene.operation.frequency_to > 0)) return out;
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

System layout_in(const SystemScene& scene, const std::string& path) {
  return placed_in(path, [&] { return layout_of(scene); });
}

void check_at_rest_in(const SystemScene& scene, const System& layout, const std::string& path) {
  placed_in(path, [&] { check_at_rest(scene, layout); });
}

}  // namespace whine
