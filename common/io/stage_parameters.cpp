#include "io/scene.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "io/keys.h"
#include "io/module_lengths.h"
#include "io/publish.h"
#include "io/section_reader.h"
#include "io/stage_parameters_text.h"
#include "io/study.h"

namespace whine {
namespace {

constexpr const char *kBodyStage = "the body of a gear", *kStaticStage = "the static stage",
                     *kImpactStage = "the ring-down", *kSweepStage = "a sweep", *kMapStage = "a map of jumps",
                     *kLumpedStage = "a sweep of a lumped model",
                     *kLumpedMapStage = "a map of a lumped model", *kVariantStage = "a variant of a study";

// Section of stage parameters with what is a variant's own: its torque, the directions of its sweeps.
constexpr const char* kVariant = "variant";

// The parameters of a stage, whose file gear-scene calls `name`; rejects a whole scene and the parameters of another stage
// than these, which may hold the same keys with other values.
Source stage_parameters_source(const std::string& path, const std::string& name, const std::string& stage,
                               const std::string& other = "") {
  Source source(path, "stage parameters are out/<scene>/" + name + ", made with: make out/<scene>/" + name);
  if (!source.is_stage_parameters() && source.root().contains("gear") &&
      source.root().contains("operation")) {
    const std::string stem = std::filesystem::path(path).stem().string(),
                      settings = "out/" + stem + "/" + name;
    source.reject(
        text("is a whole scene; this stage reads the stage parameters that gear-scene writes from it: give ",
             settings, " (make SCENE=", path, " ", settings, ")"));
  }
  if (source.is_stage_parameters() && source.stage_of() != stage && source.stage_of() != other)
    source.reject(text("is what ", source.stage_of(), " depends on, and this stage reads what ", stage,
                       " depends on: give out/<scene>/", name));
  return source;
}

// Reads one section of stage parameters; all its keys must be there.
void read_parameter_section(const Source& source, const std::string& section, const std::string& label,
                            const std::set<KeyGroup>& parts, SceneParameters& values) {
  const toml::table* table = source.section(label);
  if (!table)
    source.reject(text(
        "lacks the section [", label, "]: ",
        source.is_stage_parameters()
            ? "it holds the parameters of another stage, or old ones; give out/<scene>/params/<stage>.toml"
            : "it holds no stage parameters; gear-scene writes them from a scene, out/<scene>/params/<stage>.toml"));
  SectionReader(source, Dialect::settings, *table, section, label).read(values, parts, false);
}

}  // namespace

std::string body_parameters(const Scene& scene, const std::string& gear) {
  const SceneGear& chosen = scene.gear(gear);
  return body_parameters({chosen.design, chosen.material, scene.body});
}

std::string body_parameters(const BodyParameters& chosen) {
  SceneParameters values;
  values.design = chosen.design;
  values.material = chosen.material;
  values.body = chosen.discretisation;
  take_module(values, {KeyGroup::body, KeyGroup::near_field}, chosen.design.module);
  StageParametersText out(kBodyStage);
  out.add("gear", "gear", values,
          values.design.internal ? std::set{KeyGroup::design} : std::set{KeyGroup::design, KeyGroup::bore});
  if (values.design.internal) out.add("gear", "rim", values, {KeyGroup::rim});
  if (values.design.elastic_rim()) out.add("gear", "rim", values, {KeyGroup::rim_support});
  if (values.design.crack.depth > 0) out.add("crack", "crack", values, {KeyGroup::crack});
  out.add("material", "material", values, {KeyGroup::material});
  out.add("fidelity", "fidelity", values, {KeyGroup::body});
  out.add("discretisation", "discretisation", values, {KeyGroup::body});
  if (values.body.near_field != BodyDiscretisation{}.near_field)
    out.add("discretisation", "discretisation", values, {KeyGroup::near_field});
  return out.text();
}

namespace {

SceneParameters static_values(const Scene& scene) {
  SceneParameters values;
  values.mesh = scene.mesh;
  values.fidelity = scene.fidelity;
  values.contact = scene.contact;
  if (values.contact.positions == 0) {
    values.contact.positions = std::max(128, scene.time.steps_per_period);
    int periods = 1;  // after which the same teeth meet
    for (const std::string& name : scene.mesh.gear)
      if (!scene.gear(name).errors.none()) periods = std::lcm(periods, scene.gear(name).design.teeth);
    constexpr int kMostInAll = 16384, kLeast = 16;
    if (periods > 1)
      values.contact.positions = std::clamp(kMostInAll / periods, kLeast, values.contact.positions);
  }
  return values;
}

// moving: with what a motion needs in the same sections.
void add_static(StageParametersText& out, const Scene& scene, SceneParameters& values, bool moving) {
  out.add("mesh", "mesh", values, {KeyGroup::mesh});
  // Left out where contact has the bodies' plane state, as all stage parameters had before there was a choice.
  if (values.mesh.contact_plane != GearMeshSpec{}.contact_plane)
    out.add("mesh", "mesh", values, {KeyGroup::contact_plane});
  if (values.mesh.friction.acts()) out.add("friction", "friction", values, {KeyGroup::friction});
  for (const GearSection& own : kGearSections)
    for (int g = 0; g < kSides; ++g) {
      take_gear(values, scene.mesh, g);
      if (own.stands(values)) out.add(own.name, own.of(g), values, {own.part});
    }
  using Parts = std::set<KeyGroup>;
  out.add("fidelity", "fidelity", values,
          moving ? Parts{KeyGroup::level, KeyGroup::contact_level} : Parts{KeyGroup::contact_level});
  out.add("discretisation", "discretisation", values,
          moving ? Parts{KeyGroup::contact, KeyGroup::time} : Parts{KeyGroup::contact});
  // Going back to an earlier design finds its old body.h5, older than the static result of the design
  // between: only this text can tell make that the result is stale.
  for (int g = 0; g < kSides; ++g)
    out.add_line("body", kRole[g], body_hash(body_parameters(scene, scene.mesh.gear[g])));
}

}  // namespace

std::string static_parameters(const Scene& scene) {
  SceneParameters values = static_values(scene);
  StageParametersText out(kStaticStage);
  add_static(out, scene, values, false);
  return out.text();
}

namespace {

SceneParameters motion_values(const Scene& scene) {
  SceneParameters values;
  values.damping = scene.damping;
  values.operation = scene.operation;
  if (scene.operation.torques.empty()) fail(Failure::input, "the scene lists no torque");
  values.operation.torques = {scene.operation.torques.front()};
  values.fidelity = scene.fidelity;
  values.time = scene.time;
  return values;
}

void add_inertia(StageParametersText& out, const Scene& scene, SceneParameters& values) {
  for (int g = 0; g < kSides; ++g) {
    values.total_inertia = scene.gear(scene.mesh.gear[g]).total_inertia;
    out.add("gear", kRole[g], values, {KeyGroup::inertia});
  }
}

void add_inertia_and_damping(StageParametersText& out, const Scene& scene, SceneParameters& values) {
  add_inertia(out, scene, values);
  out.add("damping", "damping", values, {KeyGroup::damping});
}

}  // namespace

std::string impact_parameters(const Scene& scene) {
  SceneParameters values = motion_values(scene);
  StageParametersText out(kImpactStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {KeyGroup::load});
  out.add("fidelity", "fidelity", values, {KeyGroup::level, KeyGroup::contact_level});
  return out.text();
}

std::string sweep_parameters(const Scene& scene) {
  SceneParameters values = motion_values(scene);
  StageParametersText out(kSweepStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {KeyGroup::load, KeyGroup::operation});
  out.add("fidelity", "fidelity", values, {KeyGroup::level, KeyGroup::contact_level});
  out.add("discretisation", "discretisation", values, {KeyGroup::time});
  return out.text();
}

std::string map_parameters(const Scene& scene) {
  SceneParameters values = motion_values(scene);
  values.damping.rayleigh_stiffness = 0;
  StageParametersText out(kMapStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {KeyGroup::load});
  out.add("fidelity", "fidelity", values, {KeyGroup::level, KeyGroup::contact_level});
  out.add("discretisation", "discretisation", values, {KeyGroup::time});
  return out.text();
}

std::string lumped_parameters(const Scene& scene, bool speeds) {
  SceneParameters values = motion_values(scene);
  StageParametersText out(speeds ? kLumpedStage : kLumpedMapStage);
  add_inertia(out, scene, values);
  out.add(
      "operation", "operation", values,
      speeds ? std::set<KeyGroup>{KeyGroup::load, KeyGroup::operation} : std::set<KeyGroup>{KeyGroup::load});
  out.add("fidelity", "fidelity", values, {KeyGroup::contact_level});
  out.add("discretisation", "discretisation", values, {KeyGroup::time});
  return out.text();
}

std::string variant_stage_parameters(const Scene& scene, double torque,
                                     const std::vector<Direction>& directions) {
  SceneParameters values = static_values(scene);
  const SceneParameters moving = motion_values(scene);
  values.damping = moving.damping;
  values.time = moving.time;
  StageParametersText out(kVariantStage);
  add_static(out, scene, values, !directions.empty());
  if (!directions.empty()) {
    add_inertia_and_damping(out, scene, values);
    values.operation = moving.operation;
    out.add("operation", "operation", values, {KeyGroup::load, KeyGroup::operation});
  }
  values.operation.torques = {torque};
  out.add("operation", kVariant, values, {KeyGroup::load});
  out.add_line(kVariant, "directions", names_of(directions));
  return out.text();
}

std::string body_hash(const std::string& settings) {
  return sha256(settings).substr(0, 16);
}

BodyParameters read_body_parameters(const std::string& path) {
  const Source source = stage_parameters_source(path, "<gear>/body.toml", kBodyStage);
  SceneParameters values;
  const bool internal = source.section("rim") != nullptr;
  read_parameter_section(source, "gear", "gear",
                         internal ? std::set{KeyGroup::design} : std::set{KeyGroup::design, KeyGroup::bore},
                         values);
  if (internal) read_parameter_section(source, "gear", "rim", {KeyGroup::rim}, values);
  if (internal && source.section("rim")->contains("rim_radial_stiffness"))
    read_parameter_section(source, "gear", "rim", {KeyGroup::rim_support}, values);
  if (source.section("crack")) read_parameter_section(source, "crack", "crack", {KeyGroup::crack}, values);
  read_parameter_section(source, "material", "material", {KeyGroup::material}, values);
  read_parameter_section(source, "fidelity", "fidelity", {KeyGroup::body}, values);
  read_parameter_section(source, "discretisation", "discretisation", {KeyGroup::body}, values);
  if (source.section("discretisation")->contains("near_field"))
    read_parameter_section(source, "discretisation", "discretisation", {KeyGroup::near_field}, values);
  else
    values.body.matching_depth = 0;  // of the other near field that the error budget tries: its default
  take_module(values, {KeyGroup::near_field}, values.design.module);
  return {values.design, values.material, values.body};
}

namespace {

StaticParameters static_from(const Source& source) {
  SceneParameters values;
  read_parameter_section(source, "mesh", "mesh", {KeyGroup::mesh}, values);
  if (source.section("mesh")->contains("contact_plane"))
    read_parameter_section(source, "mesh", "mesh", {KeyGroup::contact_plane}, values);
  if (source.section("friction"))
    read_parameter_section(source, "friction", "friction", {KeyGroup::friction}, values);
  read_parameter_section(source, "fidelity", "fidelity", {KeyGroup::contact_level}, values);
  read_parameter_section(source, "discretisation", "discretisation", {KeyGroup::contact}, values);
  StaticParameters out{values.mesh, values.fidelity, values.contact};
  const toml::table* bodies = source.section("body");
  for (int g = 0; g < kSides; ++g) {
    SceneParameters of_gear;
    for (const GearSection& own : kGearSections)
      if (source.section(own.of(g))) read_parameter_section(source, own.name, own.of(g), {own.part}, of_gear);
    put_gear(of_gear, out.mesh, g);
    if (bodies) out.body[g] = (*bodies)[kRole[g]].value_or(std::string());
  }
  return out;
}

void read_inertia(const Source& source, ImpactParameters& out) {
  for (int g = 0; g < kSides; ++g) {
    SceneParameters values;
    read_parameter_section(source, "gear", kRole[g], {KeyGroup::inertia}, values);
    out.inertia[g] = values.total_inertia;
  }
}

ImpactParameters impact_from(const Source& source) {
  SceneParameters values;
  ImpactParameters out;
  read_inertia(source, out);
  read_parameter_section(source, "damping", "damping", {KeyGroup::damping}, values);
  read_parameter_section(source, "operation", "operation", {KeyGroup::load}, values);
  read_parameter_section(source, "fidelity", "fidelity", {KeyGroup::level, KeyGroup::contact_level}, values);
  out.damping = values.damping;
  out.reference_torque = values.operation.torques.front();
  out.fidelity = values.fidelity;
  return out;
}

void read_speeds(const Source& source, SweepParameters& out) {
  SceneParameters values;
  read_parameter_section(source, "operation", "operation", {KeyGroup::operation}, values);
  out.frequency_from = values.operation.frequency_from;
  out.frequency_to = values.operation.frequency_to;
  out.frequency_step = values.operation.frequency_step;
}

SweepParameters read_motion(const Source& source) {
  SweepParameters out;
  static_cast<ImpactParameters&>(out) = impact_from(source);
  SceneParameters values;
  read_parameter_section(source, "discretisation", "discretisation", {KeyGroup::time}, values);
  out.time = values.time;
  return out;
}

}  // namespace

StaticParameters read_static_parameters(const std::string& path) {
  return static_from(stage_parameters_source(path, "params/static.toml", kStaticStage));
}

VariantParameters read_variant_parameters(const std::string& path) {
  const Source source(path, "a variant's stage parameters are written by: make study STUDY=<name>");
  SceneParameters values;
  read_parameter_section(source, "operation", kVariant, {KeyGroup::load}, values);
  VariantParameters out;
  out.statics = static_from(source);
  out.torque = values.operation.torques.front();
  const std::string words = (*source.section(kVariant))["directions"].value_or(std::string());
  const auto directions = choices_in<Direction>(words);
  if (!directions) source.reject(text("names the directions '", words, "'; there are up and down"));
  out.directions = *directions;
  if (out.directions.empty()) return out;
  out.motion = read_motion(source);
  read_speeds(source, out.motion);
  return out;
}

ImpactParameters read_impact_parameters(const std::string& path) {
  return impact_from(stage_parameters_source(path, "params/impact.toml", kImpactStage));
}

SweepParameters read_map_parameters(const std::string& path) {
  return read_motion(stage_parameters_source(path, "params/map.toml", kMapStage));
}

SweepParameters read_sweep_parameters(const std::string& path) {
  const Source source = stage_parameters_source(path, "params/sweep.toml", kSweepStage);
  SweepParameters out = read_motion(source);
  read_speeds(source, out);
  return out;
}

SweepParameters read_lumped_parameters(const std::string& path, bool speeds) {
  const Source source = stage_parameters_source(
      path, speeds ? "params/lumped.toml" : "params/lumped_map.toml", speeds ? kLumpedStage : kLumpedMapStage,
      speeds ? kSweepStage : "");  // a sweep's holds all of it
  SweepParameters out;
  read_inertia(source, out);
  SceneParameters values;
  read_parameter_section(source, "operation", "operation", {KeyGroup::load}, values);
  read_parameter_section(source, "fidelity", "fidelity", {KeyGroup::contact_level}, values);
  read_parameter_section(source, "discretisation", "discretisation", {KeyGroup::time}, values);
  out.reference_torque = values.operation.torques.front();
  out.fidelity.contact = values.fidelity.contact;
  out.time = values.time;
  if (speeds) read_speeds(source, out);
  return out;
}

}  // namespace whine
