#include "io/system_scene.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "base/error.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "io/section_reader.h"
#include "io/stage_parameters_text.h"
#include "io/system_layout_text.h"
#include "system/system_rest.h"

namespace whine {
namespace {

constexpr const char *kSystemStaticStage = "the statics of a system",
                     *kSystemSweepStage = "a sweep of a system";
constexpr int kPositions = 128;  // where the scene leaves them open

std::string mesh_label(size_t number) {
  return "mesh_" + std::to_string(number);
}

std::string modification_label(const std::string& gear) {
  return "modification_" + gear;
}

std::string error_label(const std::string& body) {
  return "error_" + body;
}

// [body] Planets have the errors of their gear; what is drawn within a class differs from planet to planet by the seed.
std::vector<ToothErrors> errors_of(const SystemScene& scene, const std::vector<std::string>& gear_of) {
  std::vector<ToothErrors> out(gear_of.size());
  for (size_t b = 0; b < gear_of.size(); ++b)
    for (const SystemScene::Gear& gear : scene.gears)
      if (gear.name == gear_of[b]) {
        const auto before =
            std::count(gear_of.begin(), gear_of.begin() + static_cast<std::ptrdiff_t>(b), gear.name);
        out[b] = gear.errors;
        out[b].seed = static_cast<int>((gear.errors.seed + static_cast<long>(before)) % (1L << 31));
      }
  return out;
}

// Of a period of which teeth that differ make `periods`: fewer positions each, as of pairs.
int default_positions(int periods) {
  constexpr int kMostInAll = 16384, kLeast = 16;
  return std::clamp(kMostInAll / periods, kLeast, kPositions);
}

}  // namespace

BodySettings body_parameters_of(const SystemScene& scene) {
  BodySettings out;
  if (scene.rigid()) return out;
  for (const SystemScene::Gear& gear : scene.gears)
    out.emplace_back(gear.name, body_parameters({gear.design, gear.material, scene.body}));
  return out;
}

SystemStaticParameters static_parameters_of(const SystemScene& scene, const System& layout) {
  SystemStaticParameters out;
  out.layout = layout;
  out.gear = gears_of(scene, layout);
  for (const SystemScene::Mesh& mesh : scene.meshes) out.mesh.push_back(mesh.spec);
  out.section = sections_of(out.mesh, out.gear, layout);
  out.fidelity = scene.fidelity;
  out.contact = scene.contact;
  out.errors = errors_of(scene, out.gear);
  if (out.contact.positions == 0) out.contact.positions = default_positions(hunting_periods(out));
  for (const auto& [gear, settings] : body_parameters_of(scene))
    out.body.emplace_back(gear, body_hash(settings));
  return out;
}

namespace {

using Parts = std::set<KeyGroup>;

// values: with what a motion needs, if `moving`.
std::string parameters_text(const char* stage, const SystemStaticParameters& p, SceneParameters values,
                            bool moving) {
  StageParametersText out(stage);
  for (size_t m = 0; m < p.mesh.size(); ++m) {
    values.mesh = p.mesh[m];
    out.add("mesh", mesh_label(m), values, {KeyGroup::mesh, KeyGroup::contact_plane});
  }
  for (const auto& [gear, hash] : p.body) {
    values.modification = p.modification(gear);
    if (values.modification != FlankModification{})
      out.add("modification", modification_label(gear), values, {KeyGroup::modification});
  }
  for (size_t b = 0; b < p.errors.size(); ++b)
    if (p.has_errors(b)) {
      values.errors = p.errors[b];
      const std::string label = error_label(p.layout.bodies[b].name);
      out.add("error", label, values, {KeyGroup::error});
    }
  values.fidelity = p.fidelity;
  values.contact = p.contact;
  if (moving) {
    out.add("damping", "damping", values, {KeyGroup::damping});
    out.add("operation", "operation", values, {KeyGroup::operation});
  }
  out.add("fidelity", "fidelity", values,
          moving ? Parts{KeyGroup::level, KeyGroup::contact_level} : Parts{KeyGroup::contact_level});
  out.add("discretisation", "discretisation", values,
          moving ? Parts{KeyGroup::contact, KeyGroup::time} : Parts{KeyGroup::contact});
  for (const auto& [gear, hash] : p.body) out.add_line("bodies", gear, hash);
  for (size_t b = 0; b < p.gear.size(); ++b)
    if (!p.gear[b].empty()) out.add_line("gear_of", p.layout.bodies[b].name, p.gear[b]);
  return out.text() + layout_text(p.layout);
}

}  // namespace

std::string system_static_parameters(const SystemStaticParameters& p) {
  return parameters_text(kSystemStaticStage, p, {}, false);
}

SystemSweepParameters sweep_parameters_of(const SystemScene& scene, const System& layout) {
  SystemSweepParameters out;
  static_cast<SystemStaticParameters&>(out) = static_parameters_of(scene, layout);
  out.damping = scene.damping;
  out.frequency_from = scene.operation.frequency_from;
  out.frequency_to = scene.operation.frequency_to;
  out.frequency_step = scene.operation.frequency_step;
  out.time = scene.time;
  return out;
}

std::string system_sweep_parameters(const SystemSweepParameters& p) {
  SceneParameters values;
  values.damping = p.damping;
  values.operation.frequency_from = p.frequency_from;
  values.operation.frequency_to = p.frequency_to;
  values.operation.frequency_step = p.frequency_step;
  values.time = p.time;
  return parameters_text(kSystemSweepStage, p, values, true);
}

std::vector<std::pair<std::string, std::string>> elastic_parameters(const SystemScene& scene,
                                                                    const System& layout) {
  std::vector<std::pair<std::string, std::string>> out{
      {"system_static.toml", system_static_parameters(static_parameters_of(scene, layout))}};
  if (scene.operation.frequency_to > 0)
    out.emplace_back("system_sweep.toml", system_sweep_parameters(sweep_parameters_of(scene, layout)));
  return out;
}

std::string system_parameters_for(const std::string& scene, const std::string& path) {
  const SystemScene read = read_system_scene(scene);
  const std::filesystem::path place(path);
  const std::string name = place.filename().string();
  if (name == "system.toml" && read.rigid()) return system_parameters(layout_in(read, scene));
  if (!read.rigid())
    for (const auto& [own, words] : elastic_parameters(read, layout_in(read, scene)))
      if (name == own) return words;
  const std::string folder = place.parent_path().filename().string();
  for (const auto& [gear, settings] : body_parameters_of(read))
    if (name == "body.toml" && (folder == body_hash(settings) || folder == gear)) return settings;
  return "";
}

namespace {

// values: what a motion needs, if `moving`.
SystemStaticParameters parameters_from(const Source& source, SceneParameters& values, bool moving) {
  SystemStaticParameters out;
  out.layout = layout_from(source);
  const auto section = [&](const std::string& name) -> const toml::table& {
    const toml::table* table = source.section(name);
    if (!table) source.reject(text("lacks the section [", name, "]; it is made by gear-scene"));
    return *table;
  };
  const toml::table& bodies = section("bodies");
  for (const auto& [gear, hash] : bodies)
    out.body.emplace_back(std::string(gear.str()), hash.value_or(std::string()));
  // In the order of the file, which is that of the scene.
  std::stable_sort(out.body.begin(), out.body.end(), [&](const auto& a, const auto& b) {
    return bodies.get(a.first)->source().begin.line < bodies.get(b.first)->source().begin.line;
  });
  for (size_t m = 0; m == 0 || source.section(mesh_label(m)); ++m) {
    SectionReader(source, Dialect::settings, section(mesh_label(m)), "mesh", mesh_label(m))
        .read(values, {KeyGroup::mesh, KeyGroup::contact_plane}, false);
    out.mesh.push_back(values.mesh);
  }
  for (const auto& [gear, hash] : out.body) {
    SceneParameters own;
    const std::string label = modification_label(gear);
    if (!source.section(label)) continue;
    SectionReader(source, Dialect::settings, section(label), "modification", label)
        .read(own, {KeyGroup::modification}, false);
    out.modify(gear, own.modification);
  }
  for (size_t b = 0; b < out.layout.bodies.size(); ++b) {
    SceneParameters own;
    const std::string label = error_label(out.layout.bodies[b].name);
    if (const toml::table* table = source.section(label))
      SectionReader(source, Dialect::settings, *table, "error", label).read(own, {KeyGroup::error}, false);
    out.errors.push_back(own.errors);
  }
  SectionReader(source, Dialect::settings, section("fidelity"), "fidelity", "fidelity")
      .read(values, moving ? Parts{KeyGroup::level, KeyGroup::contact_level} : Parts{KeyGroup::contact_level},
            false);
  SectionReader(source, Dialect::settings, section("discretisation"), "discretisation", "discretisation")
      .read(values, moving ? Parts{KeyGroup::contact, KeyGroup::time} : Parts{KeyGroup::contact}, false);
  if (moving)
    for (const auto& [name, part] :
         {std::pair{"damping", KeyGroup::damping}, std::pair{"operation", KeyGroup::operation}})
      SectionReader(source, Dialect::settings, section(name), name, name).read(values, {part}, false);
  out.fidelity = values.fidelity;
  out.contact = values.contact;
  const toml::table& gear_of = section("gear_of");
  const std::vector<std::string> gears = out.gears();
  for (const System::Body& body : out.layout.bodies) {
    out.gear.emplace_back();
    if (body.kind == System::BodyKind::carrier) continue;
    out.gear.back() = gear_of[body.name].value_or(std::string());
    if (std::find(gears.begin(), gears.end(), out.gear.back()) == gears.end())
      source.reject(text("[gear_of] names no gear for the body '", body.name, "'"));
  }
  try {
    out.section = sections_of(out.mesh, out.gear, out.layout);
  } catch (const Error& error) {
    source.reject(error.what());
  }
  return out;
}

}  // namespace

SystemStaticParameters read_system_static_parameters(const std::string& path) {
  const Source source(
      path,
      "stage parameters are out/<scene>/params/system_static.toml, made with: make system-static SCENE=...");
  if (!source.is_stage_parameters() || source.stage_of() != kSystemStaticStage)
    source.reject(
        "is not what the statics of a system depend on: give out/<scene>/params/system_static.toml");
  SceneParameters values;
  return parameters_from(source, values, false);
}

SystemSweepParameters read_system_sweep_parameters(const std::string& path) {
  const Source source(
      path,
      "stage parameters are out/<scene>/params/system_sweep.toml, made with: make system-sweep SCENE=...");
  if (!source.is_stage_parameters() || source.stage_of() != kSystemSweepStage)
    source.reject("is not what a sweep of a system depends on: give out/<scene>/params/system_sweep.toml");
  SceneParameters values;
  SystemSweepParameters out;
  static_cast<SystemStaticParameters&>(out) = parameters_from(source, values, true);
  out.damping = values.damping;
  out.frequency_from = values.operation.frequency_from;
  out.frequency_to = values.operation.frequency_to;
  out.frequency_step = values.operation.frequency_step;
  out.time = values.time;
  return out;
}

}  // namespace whine
