#include "io/scene.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/section_reader.h"
#include "io/slice_text.h"
#include "io/study.h"

namespace whine {
namespace {

constexpr const char *kBodyStage = "the body of a gear", *kStaticStage = "the static stage",
                     *kImpactStage = "the ring-down", *kSweepStage = "a sweep", *kMapStage = "a map of jumps",
                     *kLumpedStage = "a sweep of a lumped model",
                     *kLumpedMapStage = "a map of a lumped model", *kVariantStage = "a variant of a study";

// Section of a slice with what is a variant's own: its torque, the directions of its sweeps.
constexpr const char* kVariant = "variant";

// A slice of a stage, whose file gear-scene calls `name`; refuses a whole scene and the slice of another stage than these, which
// may hold the same keys with other values.
Source slice_source(const std::string& path, const std::string& name, const std::string& stage,
                    const std::string& other = "") {
  Source source(path, "a slice is out/<scene>/" + name + ", made with: make out/<scene>/" + name);
  if (!source.is_slice() && source.root().contains("gear") && source.root().contains("operation")) {
    const std::string stem = std::filesystem::path(path).stem().string(), slice = "out/" + stem + "/" + name;
    source.refuse(text("is a whole scene; this stage reads the slice of it that gear-scene cuts: give ",
                       slice, " (make SCENE=", path, " ", slice, ")"));
  }
  if (source.is_slice() && source.slice_of() != stage && source.slice_of() != other)
    source.refuse(text("is what ", source.slice_of(), " depends on, and this stage reads what ", stage,
                       " depends on: give out/<scene>/", name));
  return source;
}

// Reads one section of a slice; all its keys must be there.
void read_slice_section(const Source& source, const std::string& section, const std::string& label,
                        const std::set<Part>& parts, KeyValues& values) {
  const toml::table* table = source.section(label);
  if (!table)
    source.refuse(
        text("lacks the section [", label, "]: ",
             source.is_slice()
                 ? "it is the slice for another stage, or an old one; give out/<scene>/params/<stage>.toml"
                 : "it is no slice; gear-scene cuts them from a scene, out/<scene>/params/<stage>.toml"));
  SectionReader(source, Dialect::slice, *table, section, label).read(values, parts, false);
}

}  // namespace

std::string body_slice(const Scene& scene, const std::string& gear) {
  const SceneGear& chosen = scene.gear(gear);
  return body_slice({chosen.design, chosen.material, scene.body});
}

std::string body_slice(const BodySlice& chosen) {
  KeyValues values;
  values.design = chosen.design;
  values.material = chosen.material;
  values.body = chosen.discretisation;
  SliceText out(kBodyStage);
  out.add("gear", "gear", values, {Part::design});
  if (values.design.crack.depth > 0) out.add("crack", "crack", values, {Part::crack});
  out.add("material", "material", values, {Part::material});
  out.add("fidelity", "fidelity", values, {Part::body});
  out.add("discretisation", "discretisation", values, {Part::body});
  if (values.body.near_field != BodyDiscretisation{}.near_field)
    out.add("discretisation", "discretisation", values, {Part::near_field});
  return out.text();
}

namespace {

KeyValues static_values(const Scene& scene) {
  KeyValues values;
  values.mesh = scene.mesh;
  values.fidelity = scene.fidelity;
  values.contact = scene.contact;
  if (values.contact.positions == 0) {
    values.contact.positions = std::max(128, scene.time.steps_per_period);
    int periods = 1;  // after which the same teeth meet
    for (const std::string& name : {scene.mesh.driver, scene.mesh.driven})
      if (!scene.gear(name).errors.none()) periods = std::lcm(periods, scene.gear(name).design.teeth);
    constexpr int kMostInAll = 16384, kLeast = 16;
    if (periods > 1)
      values.contact.positions = std::clamp(kMostInAll / periods, kLeast, values.contact.positions);
  }
  return values;
}

// moving: with what a motion needs in the same sections.
void add_static(SliceText& out, const Scene& scene, KeyValues& values, bool moving) {
  out.add("mesh", "mesh", values, {Part::mesh});
  // Left out where contact has the bodies' plane state, as every slice had before there was a choice.
  if (values.mesh.contact_plane != GearMeshSpec{}.contact_plane)
    out.add("mesh", "mesh", values, {Part::contact_plane});
  // Left out for flanks as they are designed, whose slices are what they were before flanks could be others.
  for (int g = 0; g < 2; ++g) {
    values.modification = scene.mesh.modification[g];
    if (values.modification != FlankModification{})
      out.add("modification", kModificationOf[g], values, {Part::modification});
  }
  for (int g = 0; g < 2; ++g) {
    values.errors = scene.mesh.errors[g];
    if (!values.errors.none()) out.add("error", kErrorOf[g], values, {Part::error});
  }
  for (int g = 0; g < 2; ++g) {
    values.bearing = scene.mesh.bearing[g];
    if (values.bearing.elastic()) out.add("bearing", kBearingOf[g], values, {Part::bearing});
  }
  using Parts = std::set<Part>;
  out.add("fidelity", "fidelity", values,
          moving ? Parts{Part::rung, Part::contact_rung} : Parts{Part::contact_rung});
  out.add("discretisation", "discretisation", values,
          moving ? Parts{Part::contact, Part::time} : Parts{Part::contact});
  // Going back to an earlier design finds its old body.h5, older than the static result of the design
  // between: only this text can tell make that the result is stale.
  out.add_line("body", "driver", body_hash(body_slice(scene, scene.mesh.driver)));
  out.add_line("body", "driven", body_hash(body_slice(scene, scene.mesh.driven)));
}

}  // namespace

std::string static_slice(const Scene& scene) {
  KeyValues values = static_values(scene);
  SliceText out(kStaticStage);
  add_static(out, scene, values, false);
  return out.text();
}

namespace {

KeyValues motion_values(const Scene& scene) {
  KeyValues values;
  values.damping = scene.damping;
  values.operation = scene.operation;
  if (scene.operation.torques.empty()) fail(Failure::input, "the scene lists no torque");
  values.operation.torques = {scene.operation.torques.front()};
  values.fidelity = scene.fidelity;
  values.time = scene.time;
  return values;
}

void add_inertia(SliceText& out, const Scene& scene, KeyValues& values) {
  for (const auto& [label, name] :
       {std::pair{"driver", scene.mesh.driver}, std::pair{"driven", scene.mesh.driven}}) {
    values.total_inertia = scene.gear(name).total_inertia;
    out.add("gear", label, values, {Part::inertia});
  }
}

void add_inertia_and_damping(SliceText& out, const Scene& scene, KeyValues& values) {
  add_inertia(out, scene, values);
  out.add("damping", "damping", values, {Part::damping});
}

}  // namespace

std::string impact_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  SliceText out(kImpactStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  return out.text();
}

std::string sweep_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  SliceText out(kSweepStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load, Part::operation});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string map_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  values.damping.rayleigh_stiffness = 0;
  SliceText out(kMapStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string lumped_slice(const Scene& scene, bool speeds) {
  KeyValues values = motion_values(scene);
  SliceText out(speeds ? kLumpedStage : kLumpedMapStage);
  add_inertia(out, scene, values);
  out.add("operation", "operation", values,
          speeds ? std::set<Part>{Part::load, Part::operation} : std::set<Part>{Part::load});
  out.add("fidelity", "fidelity", values, {Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string variant_slice(const Scene& scene, double torque, const std::vector<std::string>& directions) {
  KeyValues values = static_values(scene);
  const KeyValues moving = motion_values(scene);
  values.damping = moving.damping;
  values.time = moving.time;
  SliceText out(kVariantStage);
  add_static(out, scene, values, !directions.empty());
  if (!directions.empty()) {
    add_inertia_and_damping(out, scene, values);
    values.operation = moving.operation;
    out.add("operation", "operation", values, {Part::load, Part::operation});
  }
  values.operation.torques = {torque};
  out.add("operation", kVariant, values, {Part::load});
  out.add_line(kVariant, "directions", joined(directions, " "));
  return out.text();
}

std::string body_hash(const std::string& slice) {
  return sha256(slice).substr(0, 16);
}

BodySlice read_body_slice(const std::string& path) {
  const Source source = slice_source(path, "<gear>/body.toml", kBodyStage);
  KeyValues values;
  read_slice_section(source, "gear", "gear", {Part::design}, values);
  if (source.section("crack")) read_slice_section(source, "crack", "crack", {Part::crack}, values);
  read_slice_section(source, "material", "material", {Part::material}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::body}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::body}, values);
  if (source.section("discretisation")->contains("near_field"))
    read_slice_section(source, "discretisation", "discretisation", {Part::near_field}, values);
  return {values.design, values.material, values.body};
}

namespace {

StaticSlice read_static(const Source& source) {
  KeyValues values;
  read_slice_section(source, "mesh", "mesh", {Part::mesh}, values);
  if (source.section("mesh")->contains("contact_plane"))
    read_slice_section(source, "mesh", "mesh", {Part::contact_plane}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::contact_rung}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::contact}, values);
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kModificationOf[g])) continue;
    read_slice_section(source, "modification", kModificationOf[g], {Part::modification}, values);
    values.mesh.modification[g] = values.modification;
  }
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kErrorOf[g])) continue;
    read_slice_section(source, "error", kErrorOf[g], {Part::error}, values);
    values.mesh.errors[g] = values.errors;
  }
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kBearingOf[g])) continue;
    read_slice_section(source, "bearing", kBearingOf[g], {Part::bearing}, values);
    values.mesh.bearing[g] = values.bearing;
  }
  StaticSlice out{values.mesh, values.fidelity, values.contact, "", ""};
  if (const toml::table* bodies = source.section("body")) {
    out.driver_body = (*bodies)["driver"].value_or(std::string());
    out.driven_body = (*bodies)["driven"].value_or(std::string());
  }
  return out;
}

void read_inertia(const Source& source, ImpactSlice& out) {
  KeyValues values;
  read_slice_section(source, "gear", "driver", {Part::inertia}, values);
  out.driver_inertia = values.total_inertia;
  read_slice_section(source, "gear", "driven", {Part::inertia}, values);
  out.driven_inertia = values.total_inertia;
}

ImpactSlice read_impact(const Source& source) {
  KeyValues values;
  ImpactSlice out;
  read_inertia(source, out);
  read_slice_section(source, "damping", "damping", {Part::damping}, values);
  read_slice_section(source, "operation", "operation", {Part::load}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::rung, Part::contact_rung}, values);
  out.damping = values.damping;
  out.reference_torque = values.operation.torques.front();
  out.fidelity = values.fidelity;
  return out;
}

void read_speeds(const Source& source, SweepSlice& out) {
  KeyValues values;
  read_slice_section(source, "operation", "operation", {Part::operation}, values);
  out.frequency_from = values.operation.frequency_from;
  out.frequency_to = values.operation.frequency_to;
  out.frequency_step = values.operation.frequency_step;
}

SweepSlice read_motion(const Source& source) {
  SweepSlice out;
  static_cast<ImpactSlice&>(out) = read_impact(source);
  KeyValues values;
  read_slice_section(source, "discretisation", "discretisation", {Part::time}, values);
  out.time = values.time;
  return out;
}

}  // namespace

StaticSlice read_static_slice(const std::string& path) {
  return read_static(slice_source(path, "params/static.toml", kStaticStage));
}

VariantSlice read_variant_slice(const std::string& path) {
  const Source source(path, "a variant's slice is written by: make study STUDY=<name>");
  KeyValues values;
  read_slice_section(source, "operation", kVariant, {Part::load}, values);
  VariantSlice out;
  out.statics = read_static(source);
  out.torque = values.operation.torques.front();
  std::istringstream words((*source.section(kVariant))["directions"].value_or(std::string()));
  for (std::string word; words >> word;) {
    if (word != "up" && word != "down")
      source.refuse(text("names the direction '", word, "'; there are up and down"));
    out.directions.push_back(word);
  }
  if (out.directions.empty()) return out;
  out.motion = read_motion(source);
  read_speeds(source, out.motion);
  return out;
}

ImpactSlice read_impact_slice(const std::string& path) {
  return read_impact(slice_source(path, "params/impact.toml", kImpactStage));
}

SweepSlice read_map_slice(const std::string& path) {
  return read_motion(slice_source(path, "params/map.toml", kMapStage));
}

SweepSlice read_sweep_slice(const std::string& path) {
  const Source source = slice_source(path, "params/sweep.toml", kSweepStage);
  SweepSlice out = read_motion(source);
  read_speeds(source, out);
  return out;
}

SweepSlice read_lumped_slice(const std::string& path, bool speeds) {
  const Source source = slice_source(path, speeds ? "params/lumped.toml" : "params/lumped_map.toml",
                                     speeds ? kLumpedStage : kLumpedMapStage,
                                     speeds ? kSweepStage : "");  // a sweep's holds all of it
  SweepSlice out;
  read_inertia(source, out);
  KeyValues values;
  read_slice_section(source, "operation", "operation", {Part::load}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::contact_rung}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::time}, values);
  out.reference_torque = values.operation.torques.front();
  out.fidelity.contact = values.fidelity.contact;
  out.time = values.time;
  if (speeds) read_speeds(source, out);
  return out;
}

}  // namespace whine
