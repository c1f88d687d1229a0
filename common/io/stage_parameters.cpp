#include "io/scene.h"

#include <filesystem>

#include "base/error.h"
#include "gear/tooth_errors.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/section_reader.h"
#include "io/stage_parameters_text.h"
#include "io/study.h"
#include "model/capabilities.h"

namespace whine {
namespace {

constexpr StageFile kBody{"<gear>/body.toml", "the body of a gear"},
    kStatic{"params/static.toml", "the static stage"},
    kVariantFile{"variants/<n>.toml", "a variant of a study"};

// Section of stage parameters with what is a variant's own: its torque, the directions of its sweeps.
constexpr const char* kVariant = "variant";

}  // namespace

std::string body_parameters(const Scene& scene, const std::string& gear) {
  const SceneGear& chosen = scene.gear(gear);
  return body_parameters({chosen.design, chosen.material, scene.body});
}

namespace {

void walk(StageParameters& s, BodyParameters& p) {
  WidthDiscretisation& width = p.discretisation.width;
  KeyList all = keys(p.design).append(keys(p.material)).append(keys(p.discretisation));
  all.append_group(keys(width), width.acts(), "width");
  s(all);
}

}  // namespace

std::string body_parameters(const BodyParameters& chosen) {
  BodyParameters p = chosen;  // keys point at what may be changed
  if (double& size = p.discretisation.element_size; size == 0)
    size = p.discretisation.element_modules * p.design.module;
  take_module(keys(p.discretisation), p.design.module);
  if (p.discretisation.width.acts()) take_module(keys(p.discretisation.width), p.design.module);
  StageParameters out(kBody);
  walk(out, p);
  return out.text();
}

namespace {

StaticParameters static_of(const Scene& scene) {
  StaticParameters out{scene.mesh(), scene.fidelity, scene.contact};
  out.contact.positions = static_positions(scene);
  // make redoes static.h5 by these hashes when a scene goes back to an earlier design, whose body.h5 is older than it.
  for (int g = 0; g < kSides; ++g) out.body[g] = body_hash(body_parameters(scene, scene.mesh().gear[g]));
  return out;
}

// moving: what a motion needs in the same sections; nullptr: without.
void walk(StageParameters& s, StaticParameters& p, TimeDiscretisation* moving = nullptr) {
  s(keys(p.mesh).append(level_keys(p.fidelity, p.contact, moving)));
  for (int g = 0; g < kSides; ++g) s.word("body", kRole[g], p.body[g]);
}

// What a stage of a pair in motion depends on, beside inertia and torque.
struct MotionStage {
  StageFile file;
  bool damping, speeds, body_model, time;
  const char* feature;  // in the table of capabilities
};
constexpr MotionStage kImpact{{"params/impact.toml", "the ring-down"}, true, false, true, false, "impact"},
    kSweep{{"params/sweep.toml", "a sweep"}, true, true, true, true, "sweep"},
    kMap{{"params/map.toml", "a map of jumps"}, true, false, true, true, "jump-map"},
    kLumped{{"params/lumped.toml", "a sweep of a lumped model"}, false, true, false, true, "lumped"},
    kLumpedMap{{"params/lumped_map.toml", "a map of a lumped model"}, false, false, false, true, "lumped"};

struct Motion {
  SweepParameters p;
  std::vector<double> torques;  // one
};

Motion motion_of(const Scene& scene) {
  if (scene.operation.torques.empty()) fail(Failure::input, "the scene lists no torque");
  Motion out;
  for (int g = 0; g < kSides; ++g) out.p.inertia[g] = scene.gear(scene.mesh().gear[g]).total_inertia;
  static_cast<MotionSettings&>(out.p) = motion_settings(scene);
  out.p.fidelity = scene.fidelity;
  out.torques = {scene.operation.torques.front()};
  return out;
}

// Without what a variant says beside its statics.
KeyList running_keys(Motion& m, const MotionStage& stage) {
  KeyList out;
  for (int g = 0; g < kSides; ++g) out.append(inertia_key(m.p.inertia[g]).labelled(kRole[g]));
  if (stage.damping) out.append(keys(m.p.damping));
  out.append(torque_key(m.torques));
  if (stage.speeds) out.append(speeds_key(m.p));
  return out;
}

KeyList motion_keys(Motion& m, const MotionStage& stage) {
  KeyList out = running_keys(m, stage);
  out.append(stage.body_model ? keys(m.p.fidelity) : keys(m.p.fidelity).only({"contact", "width"}));
  return stage.time ? out.append(keys(m.p.time)) : out;
}

std::string motion_text(Motion motion, const MotionStage& stage) {
  StageParameters out(stage.file);
  out(motion_keys(motion, stage));
  return out.text();
}

}  // namespace

std::string static_parameters(const Scene& scene) {
  StaticParameters p = static_of(scene);
  StageParameters out(kStatic);
  walk(out, p);
  return out.text();
}

std::string impact_parameters(const Scene& scene) {
  return motion_text(motion_of(scene), kImpact);
}

std::string sweep_parameters(const Scene& scene) {
  return motion_text(motion_of(scene), kSweep);
}

std::string map_parameters(const Scene& scene) {
  Motion motion = motion_of(scene);
  motion.p.damping.rayleigh_stiffness = 0;
  return motion_text(motion, kMap);
}

std::string lumped_parameters(const Scene& scene, bool speeds) {
  return motion_text(motion_of(scene), speeds ? kLumped : kLumpedMap);
}

std::string variant_stage_parameters(const Scene& scene, double torque,
                                     const std::vector<Direction>& directions) {
  StaticParameters p = static_of(scene);
  Motion motion = motion_of(scene);
  StageParameters out(kVariantFile);
  walk(out, p, directions.empty() ? nullptr : &motion.p.time);
  if (!directions.empty()) out(running_keys(motion, kSweep));
  std::vector<double> torques{torque};
  out(torque_key(torques).labelled(kVariant));
  std::string words = names_of(directions);
  out.word(kVariant, "directions", words);
  return out.text();
}

std::string variant_stage_parameters(const StudyVariant& variant, const std::vector<Direction>& directions) {
  return variant.scene.pair() ? variant_stage_parameters(variant.scene, variant.torque, directions)
                              : system_variant_parameters(variant.scene, variant.layout, directions);
}

BodySettings body_parameters_of(const Scene& scene) {
  BodySettings out;
  for (const SceneGear& gear : scene.gears)
    if (!scene.rigid()) out.emplace_back(gear.name, body_parameters(scene, gear.name));
  return out;
}

std::vector<std::pair<std::string, std::string>> stage_parameters_of(const Scene& scene,
                                                                     const System& layout) {
  if (scene.rigid()) return {{"modes.toml", system_parameters(layout)}};
  if (scene.pair())
    return {{"static.toml", static_parameters(scene)},
            {"impact.toml", impact_parameters(scene)},
            {"sweep.toml", sweep_parameters(scene)},
            {"map.toml", map_parameters(scene)},
            {"lumped.toml", lumped_parameters(scene, true)},
            {"lumped_map.toml", lumped_parameters(scene, false)}};
  std::vector<std::pair<std::string, std::string>> out{
      {"static.toml", system_static_parameters(static_parameters_of(scene, layout))}};
  if (scene.operation.frequency_to == 0) return out;
  const SystemSweepParameters moving = sweep_parameters_of(scene, layout);
  out.emplace_back("sweep.toml", system_sweep_parameters(moving));
  out.emplace_back("impact.toml", system_impact_parameters(moving));
  return out;
}

std::string parameters_for(const std::string& path_of_scene, const std::string& path) {
  const Scene scene = read_scene(path_of_scene);
  const std::filesystem::path place(path);
  const std::string name = place.filename().string(), folder = place.parent_path().filename().string();
  for (const auto& [own, words] : stage_parameters_of(scene, layout_in(scene, path_of_scene)))
    if (name == own) return words;
  for (const auto& [gear, settings] : body_parameters_of(scene))
    if (name == "body.toml" && (folder == body_hash(settings) || folder == gear)) return settings;
  return "";
}

std::string body_hash(const std::string& settings) {
  return sha256(settings).substr(0, 16);
}

BodyParameters read_body_parameters(const std::string& path) {
  BodyParameters out;
  out.discretisation.matching_depth =
      0;  // if it is not said: of the other near field that the error budget tries
  const Source source = stage_source(path, kBody);
  StageParameters in(source);
  walk(in, out);
  take_module(keys(out.discretisation).only({"matching_depth_mm"}), out.design.module);
  return out;
}

namespace {

StaticParameters static_from(const Source& source) {
  StageParameters in(source);
  StaticParameters out;
  walk(in, out);
  return out;
}

SweepParameters motion_from(const Source& source, const MotionStage& stage) {
  Motion out;
  StageParameters in(source);
  in(motion_keys(out, stage));
  if (out.p.fidelity.width != WidthModel::one) {
    out.p.fidelity.contact = ContactModel::line;
    const Trait level =
        out.p.fidelity.width == WidthModel::body ? Trait::pair_of_bodies : Trait::pair_in_slices;
    if (const std::string words =
            refusal(stage.feature, {{level, text("[fidelity] has width = \"", out.p.fidelity.width, "\"")}});
        !words.empty())
      source.reject(words);
  }
  out.p.reference_torque = out.torques.front();
  return out.p;
}

SweepParameters read_motion(const std::string& path, const MotionStage& stage) {
  return motion_from(stage_source(path, stage.file), stage);
}

}  // namespace

StaticParameters read_static_parameters(const std::string& path) {
  return static_from(stage_source(path, kStatic));
}

VariantParameters read_variant_parameters(const std::string& path) {
  if (is_system_scene(path)) return read_system_variant_parameters(path);
  const Source source(path, "a variant's stage parameters are written by: make study STUDY=<name>");
  StageParameters in(source);
  std::vector<double> torques;
  in(torque_key(torques).labelled(kVariant));
  VariantParameters out;
  out.statics = static_from(source);
  out.torque = torques.front();
  std::string words;
  in.word(kVariant, "directions", words);
  const auto directions = choices_in<Direction>(words);
  if (!directions) source.reject("names the directions '", words, "'; there are up and down");
  out.directions = *directions;
  if (!out.directions.empty()) out.motion = motion_from(source, kSweep);
  return out;
}

SweepParameters read_impact_parameters(const std::string& path) {
  return read_motion(path, kImpact);
}

SweepParameters read_map_parameters(const std::string& path) {
  return read_motion(path, kMap);
}

SweepParameters read_sweep_parameters(const std::string& path) {
  return read_motion(path, kSweep);
}

SweepParameters read_lumped_parameters(const std::string& path, bool speeds) {
  const MotionStage& stage = speeds ? kLumped : kLumpedMap;
  // A sweep's parameters hold all of it.
  return motion_from(stage_source(path, stage.file, speeds ? kSweep.file : stage.file), stage);
}

}  // namespace whine
