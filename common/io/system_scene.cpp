#include "io/system_scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/module_lengths.h"
#include "io/scene_sections.h"
#include "io/variant.h"
#include "system/system_rest.h"

namespace whine {
namespace {

// The tables of [[name]]; none if there is no such section.
std::vector<const toml::table*> list_of(const Source& source, const std::string& name) {
  std::vector<const toml::table*> out;
  const toml::node* node = source.root().get(name);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    source.reject(*node, text("'", name, "' must be a list of sections: write [[", name, "]]"));
  for (const toml::node& item : *list) out.push_back(item.as_table());
  return out;
}

// What a gear of a system cannot have.
void reject_sections(const Source& source, const toml::table& table, const SceneGear& gear, bool rigid) {
  for (const char* key : {"modification", "error", "crack"}) {
    const toml::node* node = table.get(key);
    if (node && rigid)
      source.reject(
          *node, text("[gear.", gear.name, ".", key, "]: a gear of a system with body = \"rigid\" has no '",
                      key, "', its mesh is one spring of stiffness_N_um; take the section out"));
    if (node && key == std::string("crack"))
      source.reject(
          *node,
          text(
              "[gear.", gear.name,
              ".crack]: a gear of a system (several meshes, carriers or drives) has no 'crack': the body of a cracked gear knows what forces on its leading flanks do to the crack, and gears of a system may work with the other ones; take the section out, or compute two of the gears as a pair"));
  }
}

// The hunting period is checked at the last gear with errors, which makes it as long as it is.
void check_hunting(const Source& source, const Scene& gears) {
  std::vector<int> teeth;
  for (const SceneGear& own : gears.gears) {
    if (own.errors.none()) continue;
    teeth.push_back(own.design.teeth);
    try {
      hunting_periods_of(teeth);
    } catch (const Error& error) {
      const toml::table& table = *source.section("gear")->get(own.name)->as_table();
      source.reject(*table.get("error"), text("[gear.", own.name, ".error]: ", error.what()));
    }
  }
}

void take_gears(const Source& source, SystemScene& scene) {
  Scene gears;
  const bool rigid = scene.rigid();
  read_gears(source, gears, rigid);
  check_hunting(source, gears);
  for (const SceneGear& own : gears.gears) {
    SystemScene::Gear gear;
    static_cast<SceneGear&>(gear) = own;
    const toml::table* table = source.section("gear")->get(own.name)->as_table();
    reject_sections(source, *table, own, rigid);
    if (!rigid) {
      scene.gears.push_back(gear);
      continue;
    }
    const toml::table* owner = table;
    if (const auto like = (*table)["like"].value<std::string>(); like && !table->get("equivalent_mass_kg"))
      owner = source.section("gear")->get(*like)->as_table();
    SectionReader(source, Dialect::scene, *owner, "rigid_gear", "gear." + own.name)
        .read(equivalent_mass_key(gear.equivalent_mass));
    if (gear.equivalent_mass > 0 && gear.total_inertia > 0)
      source.reject(
          *table,
          text(
              "[gear.", own.name,
              "] gives 'total_inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them"));
    if (!(gear.equivalent_mass > 0 || gear.total_inertia > 0))
      source.reject(
          *table,
          text(
              "[gear.", own.name,
              "] of a system with body = \"rigid\" lacks its inertia: give 'total_inertia_kgm2' or 'equivalent_mass_kg'"));
    scene.gears.push_back(gear);
  }
}

void take_carriers(const Source& source, SystemScene& scene) {
  for (const toml::table* table : list_of(source, "carrier")) {
    SystemScene::Carrier carrier;
    const SectionReader reader(source, Dialect::scene, *table, "carrier", "carrier");
    reader.reject_unknown();
    reader.read(keys(carrier));
    if (!plain_name(carrier.name))
      source.reject(*table->get("name"), text("'name' in [carrier] = '", carrier.name,
                                              "': a name holds letters, digits, '_' and '-' only"));
    const bool one = carrier.inertia > 0, other = carrier.equivalent_mass > 0;
    if (one && other)
      source.reject(
          *table,
          text("[carrier] '", carrier.name,
               "' gives 'inertia_kgm2' and 'equivalent_mass_kg', which say the same; give one of them"));
    if (scene.rigid() && !one && !other)
      source.reject(*table, text("[carrier] '", carrier.name,
                                 "' needs its inertia, either 'inertia_kgm2' or 'equivalent_mass_kg'"));
    scene.carriers.push_back(carrier);
  }
}

void take_meshes(const Source& source, SystemScene& scene) {
  for (const toml::table* table : list_of(source, "mesh")) {
    SystemScene::Mesh mesh;
    const SectionReader reader(source, Dialect::scene, *table, "mesh", "mesh"),
        train(source, Dialect::scene, *table, "train_mesh", "mesh");
    reader.reject_unknown({"direction_deg", "stiffness_N_um"});
    reader.read(keys(mesh.spec).section("mesh"));
    train.read(keys(mesh));
    if (const toml::node* node = table->get("stiffness_N_um"); node && !scene.rigid())
      source.reject(
          *node,
          "'stiffness_N_um' in [mesh] belongs to body = \"rigid\"; that of elastic gears is computed, take it out");
    if (scene.rigid() && !(mesh.stiffness > 0))
      source.reject(*table, text("[mesh] of '", mesh.spec.gear[0], "' and '", mesh.spec.gear[1],
                                 "' lacks 'stiffness_N_um', which body = \"rigid\" needs"));
    for (size_t g = 0; g < kSides; ++g)
      for (const SystemScene::Gear& gear : scene.gears)
        if (gear.name == mesh.spec.gear[g]) mesh.spec.modification[g] = gear.modification;
    scene.meshes.push_back(mesh);
  }
}

void take_bearings(const Source& source, SystemScene& scene) {
  std::vector<std::string> names;
  std::vector<Bearing*> own;
  for (SystemScene::Gear& gear : scene.gears) {
    names.push_back(gear.name);
    own.push_back(&gear.bearing);
  }
  for (SystemScene::Carrier& carrier : scene.carriers) {
    names.push_back(carrier.name);
    own.push_back(&carrier.bearing);
  }
  for (const toml::table* table : list_of(source, "bearing")) {
    std::string name;
    Bearing read;
    const SectionReader reader(source, Dialect::scene, *table, "bearing", "bearing");
    reader.reject_unknown();
    reader.read(bearing_gear_key(name).append(keys(read)));
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      source.reject(*table->get("gear"), text("'gear' in [bearing] = '", name,
                                              "' names no gear and no carrier", advice_for(name, names)));
    Bearing& bearing = *own[static_cast<size_t>(at - names.begin())];
    if (bearing.elastic())
      source.reject(*table->get("gear"),
                    text("'gear' in [bearing] = '", name,
                         "' has a bearing already; give one section with what carries it in all"));
    const bool drawn = !scene.rigid() && static_cast<size_t>(at - names.begin()) < scene.gears.size();
    if (!drawn && !(read.mass > 0))
      source.reject(*table, text("[bearing] of '", name, "' lacks 'mass_kg', which ",
                                 scene.rigid() ? "body = \"rigid\"" : "a carrier", " needs"));
    bearing = read;
  }
}

void take_drives(const Source& source, SystemScene& scene) {
  for (const toml::table* table : list_of(source, "drive")) {
    SystemScene::Drive drive;
    const SectionReader reader(source, Dialect::scene, *table, "drive", "drive");
    reader.reject_unknown();
    reader.read(keys(drive));
    const auto only = [&](const char* key, System::DriveKind kind) {
      if (const toml::node* node = table->get(key); node && drive.kind != kind)
        source.reject(*node, text("'", key, "' in [drive] belongs to kind = \"", name_of(kind),
                                  "\", and this drive is of kind \"", name_of(drive.kind), "\""));
    };
    only("torque_Nm", System::DriveKind::torque);
    only("stiffness_N_um", System::DriveKind::held);
    if (const toml::node* node = table->get("stiffness_N_um"); node && !scene.rigid())
      source.reject(
          *node,
          "'stiffness_N_um' in [drive] belongs to body = \"rigid\"; elastic gears are held rigidly, take it out");
    scene.drives.push_back(drive);
  }
}

// What systems in motion cannot do, before anything is computed for them.
void reject_in_motion(const Source& source, const Fidelity& fidelity) {
  const auto reject = [&](const char* key, const std::string& words) {
    const toml::node* node = source.root().at_path(std::string("fidelity.") + key).node();
    if (node) source.reject(*node, words);
    source.reject(words);
  };
  if (fidelity.body == BodyModel::full)
    reject(
        "body",
        "body = \"full\" in [fidelity]: systems in motion have \"quasi-static\", \"relaxed\" or \"modal\"; write one of these, or take [operation] out");
  if (fidelity.integrator != Integrator::exact)
    reject(
        "integrator",
        text(
            "integrator = \"", fidelity.integrator,
            "\" in [fidelity] is for pairs: systems in motion have \"exact\"; write that, or take [operation] out"));
}

// [fidelity], [discretisation], [damping] and [operation].
void take_fidelity(const Source& source, SystemScene& scene) {
  static const toml::table kNothing;
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
  for (const char* name : {"fidelity", "discretisation", "damping", "operation"}) {
    const std::string section(name);
    if (const toml::node* node = source.root().get(section);
        node && scene.fidelity.body == BodyModel::rigid && (section == "damping" || section == "operation"))
      source.reject(
          *node,
          text("[", section,
               "] belongs to elastic gears in motion, and those of this scene are rigid; take it out"));
    const toml::table* table = source.section(name);
    const SectionReader reader(source, Dialect::scene, table ? *table : kNothing, name, name);
    reader.reject_unknown();
    reader.read(all.section(section));
  }
  if (moves && scene.fidelity.body != BodyModel::rigid) reject_in_motion(source, scene.fidelity);
  if (const toml::node* node = source.root().get("discretisation"); node && scene.rigid())
    source.reject(
        *node, "[discretisation] belongs to elastic gears, and those of this scene are rigid; take it out");
  if (scene.fidelity.body == BodyModel::full) scene.body.modes = kAllModes;
}

// Names of gears that share a shaft come first: what else a scene of them lacks leads nowhere.
void require_one_train(const Source& source) {
  const std::vector<const toml::table*> tables = list_of(source, "mesh");
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

SystemScene read_system_scene(const std::string& path) {
  const Source source(path);
  if (source.is_stage_parameters())
    source.reject("holds stage parameters, which gear-scene wrote from a scene; give the scene itself");
  require_one_train(source);
  const SectionReader top(source, Dialect::scene, source.root(), "", "");
  if (const toml::node* node = source.root().get("friction"))
    source.reject(
        *node,
        "[friction] stands in a scene of a system (several meshes, carriers or drives), whose meshes have no friction so far; take the section out");
  top.reject_unknown({"gear", "material", "bearing", "mesh", "carrier", "drive", "damping", "operation",
                      "fidelity", "discretisation"});
  for (const char* name : {"gear", "mesh"})
    if (!source.root().get(name))
      source.reject(text("the scene of a system lacks ",
                         name == std::string("gear") ? "[gear.<name>]" : "[[mesh]]",
                         "; data/scenes/lin-parker-planetary.toml is an example"));
  SystemScene scene;
  top.read(title_key(scene.title));
  if (scene.title.empty()) scene.title = std::filesystem::path(path).stem().string();
  take_fidelity(source, scene);
  take_gears(source, scene);
  double largest = 0;
  for (const SystemScene::Gear& gear : scene.gears) largest = std::max(largest, gear.design.module);
  take_module(keys(scene.damping), largest);
  take_carriers(source, scene);
  take_meshes(source, scene);
  take_bearings(source, scene);
  take_drives(source, scene);
  return scene;
}

namespace {

// What `make` gives; its SystemSceneError with file and line.
template <class Make>
auto placed_in(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const SystemSceneError& error) {
    const Source source(path);
    const auto tables = list_of(source, error.section());
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
        ", the default, is for the gears of P2000; `make SCENE=path/to/scene.toml system-ringdown` shows the damping ratios that it gives these, write your own into [damping]"));
  return out;
}

System layout_in(const SystemScene& scene, const std::string& path) {
  return placed_in(path, [&] { return layout_of(scene); });
}

void check_at_rest_in(const SystemScene& scene, const System& layout, const std::string& path) {
  placed_in(path, [&] { check_at_rest(scene, layout); });
}

}  // namespace whine
