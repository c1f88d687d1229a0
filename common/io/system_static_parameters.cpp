#include "io/system_scene.h"

#include <algorithm>
#include <filesystem>
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

// moving: with what a motion needs in these sections.
KeyList level_keys(SystemStaticParameters& p, TimeDiscretisation* moving) {
  KeyList out = moving ? keys(p.fidelity) : keys(p.fidelity).only({"contact"});
  out.append(keys(p.contact));
  return moving ? out.append(keys(*moving)) : out;
}

KeyList speed_keys(SystemSweepParameters& p) {
  return keys(p.damping).append(speeds_key(p.frequency_from, p.frequency_to, p.frequency_step));
}

KeyList mesh_keys(GearMeshSpec& mesh, size_t number) {
  return keys(mesh).section("mesh").all().labelled(mesh_label(number));
}

// moving: `p` itself, if it is of a sweep.
std::string parameters_text(const char* stage, SystemStaticParameters& p, SystemSweepParameters* moving) {
  StageParametersText out(stage);
  for (size_t m = 0; m < p.mesh.size(); ++m) out.add(mesh_keys(p.mesh[m], m));
  for (const auto& [gear, hash] : p.body)
    if (FlankModification own = p.modification(gear); own != FlankModification{})
      out.add(keys(own).labelled(modification_label(gear)));
  for (size_t b = 0; b < p.errors.size(); ++b)
    if (p.has_errors(b)) out.add(keys(p.errors[b]).labelled(error_label(p.layout.bodies[b].name)));
  if (moving) out.add(speed_keys(*moving));
  out.add(level_keys(p, moving ? &moving->time : nullptr));
  for (const auto& [gear, hash] : p.body) out.add_line("bodies", gear, hash);
  for (size_t b = 0; b < p.gear.size(); ++b)
    if (!p.gear[b].empty()) out.add_line("gear_of", p.layout.bodies[b].name, p.gear[b]);
  return out.text() + layout_text(p.layout);
}

}  // namespace

std::string system_static_parameters(const SystemStaticParameters& p) {
  SystemStaticParameters copy = p;  // keys point at what may be changed
  return parameters_text(kSystemStaticStage, copy, nullptr);
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
  SystemSweepParameters copy = p;
  return parameters_text(kSystemSweepStage, copy, &copy);
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

// moving: `out` itself, if it is of a sweep.
void read_into(const Source& source, SystemStaticParameters& out, SystemSweepParameters* moving) {
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
  for (size_t m = 0; m == 0 || source.section(mesh_label(m)); ++m)
    read_stage(source, mesh_keys(out.mesh.emplace_back(), m));
  for (const auto& [gear, hash] : out.body)
    if (const std::string label = modification_label(gear); source.section(label)) {
      FlankModification own;
      read_stage(source, keys(own).labelled(label));
      out.modify(gear, own);
    }
  for (const System::Body& body : out.layout.bodies) {
    ToothErrors& own = out.errors.emplace_back();
    if (const std::string label = error_label(body.name); source.section(label))
      read_stage(source, keys(own).labelled(label));
  }
  read_stage(source, level_keys(out, moving ? &moving->time : nullptr));
  if (moving) read_stage(source, speed_keys(*moving));
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
}

}  // namespace

SystemStaticParameters read_system_static_parameters(const std::string& path) {
  const Source source(
      path,
      "stage parameters are out/<scene>/params/system_static.toml, made with: make system-static SCENE=...");
  if (!source.is_stage_parameters() || source.stage_of() != kSystemStaticStage)
    source.reject(
        "is not what the statics of a system depend on: give out/<scene>/params/system_static.toml");
  SystemStaticParameters out;
  read_into(source, out, nullptr);
  return out;
}

SystemSweepParameters read_system_sweep_parameters(const std::string& path) {
  const Source source(
      path,
      "stage parameters are out/<scene>/params/system_sweep.toml, made with: make system-sweep SCENE=...");
  if (!source.is_stage_parameters() || source.stage_of() != kSystemSweepStage)
    source.reject("is not what a sweep of a system depends on: give out/<scene>/params/system_sweep.toml");
  SystemSweepParameters out;
  read_into(source, out, &out);
  return out;
}

}  // namespace whine
