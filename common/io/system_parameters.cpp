#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/layout_codec.h"
#include "io/scene.h"
#include "io/stage_parameters_text.h"
#include "io/variant.h"
#include "system/rigid_system.h"
#include "system/system_rest.h"

namespace whine {
namespace {

constexpr StageFile kSystemModes{"params/modes.toml", "the modes of a system"},
    kSystemStatic{"params/static.toml", "the statics of a system"},
    kSystemSweep{"params/sweep.toml", "a sweep of a system"},
    kSystemImpact{"params/impact.toml", "the ring-down of a system"},
    kSystemVariant{"variants/<n>.toml", "a variant of a study of a system"};

}  // namespace

std::optional<LayoutFault> layout_fault(const System& s) {
  const auto bodies = static_cast<int>(s.bodies.size());
  const auto gear = [&](int body) {
    return body >= 0 && body < bodies && s.bodies[static_cast<size_t>(body)].kind == System::BodyKind::gear;
  };
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    const auto fault = [&](const char* key, const auto& value, const char* allowed) {
      return LayoutFault{"body", b, key, text(value), allowed};
    };
    if (!plain_name(body.name))
      return fault("name", "'" + body.name + "'", "; a name holds letters, digits, '_' and '-' only");
    if (body.sense == 0) return fault("sense", 0, "; allowed are -1 and 1");
    if (body.kind == System::BodyKind::gear && body.teeth == 0) return fault("teeth", 0, ", which is a gear");
    if (!has_place(s, body))
      return fault("stands_on", body.on,
                   "; allowed are -1, the ground, and the number of a carrier on the ground");
  }
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const int first = s.meshes[m].side[0].body, second = s.meshes[m].side[1].body;
    if (!gear(first) || !gear(second) || first == second)
      return LayoutFault{"mesh", m, "body_number", text(first, ", ", second),
                         "; allowed are two gears that differ"};
  }
  for (size_t d = 0; d < s.drives.size(); ++d)
    if (const int body = s.drives[d].body; body < 0 || body >= bodies)
      return LayoutFault{"drive", d, "body", text(body), text("; allowed are 0 to ", bodies - 1)};
  return std::nullopt;
}

namespace {

void walk(StageParameters& s, System& layout) {
  s.list("body", layout.bodies);
  s.list("mesh", layout.meshes);
  s.list("drive", layout.drives);
  for (System::Body& body : layout.bodies)
    if (const std::string label = "offset_" + body.name; s.has(label, body.offset != std::array{0.0, 0.0}))
      s(offset_keys(body).labelled(label));
  const Source* const source = s.source();
  if (!source) return;
  layout.load = System::Load::drives;
  if (layout.bodies.empty()) source->reject("lists no [[body]]");
  if (const auto fault = layout_fault(layout)) {
    const toml::table& at = *source->list(fault->list)[fault->number];
    const std::string name = at["name"].value_or(std::string());
    source->reject(at, "[[", fault->list, "]]", name.empty() ? "" : " '" + name + "'", ": ", fault->key,
                   " = ", fault->value, fault->allowed);
  }
}

}  // namespace

std::string system_parameters(const System& layout) {
  System copy = layout;  // keys point at what may be changed
  StageParameters out(kSystemModes);
  walk(out, copy);
  return out.text();
}

System read_system_parameters(const std::string& path) {
  const Source source = stage_source(path, kSystemModes);
  StageParameters in(source);
  System out;
  walk(in, out);
  return out;
}

namespace {

// [body] Planets have the errors of their gear; what is drawn within a class differs from planet to planet by the seed.
std::vector<ToothErrors> errors_of(const Scene& scene, const std::vector<std::string>& gear_of) {
  std::vector<ToothErrors> out(gear_of.size());
  for (size_t b = 0; b < gear_of.size(); ++b)
    for (const SceneGear& gear : scene.gears)
      if (gear.name == gear_of[b]) {
        const auto before =
            std::count(gear_of.begin(), gear_of.begin() + static_cast<std::ptrdiff_t>(b), gear.name);
        out[b] = gear.errors;
        out[b].seed = static_cast<int>((gear.errors.seed + static_cast<long>(before)) % (1L << 31));
      }
  return out;
}

}  // namespace

SystemStaticParameters static_parameters_of(const Scene& scene, const System& layout) {
  SystemStaticParameters out;
  out.layout = layout;
  out.gear = gears_of(scene, layout);
  out.mesh = scene.specs();
  out.section = sections_of(out.mesh, out.gear, layout);
  out.fidelity = scene.fidelity;
  out.contact = scene.contact;
  out.errors = errors_of(scene, out.gear);
  out.contact.positions = static_positions(scene);
  for (const auto& [gear, settings] : body_parameters_of(scene))
    out.body.emplace_back(gear, body_hash(settings));
  return out;
}

SystemSweepParameters sweep_parameters_of(const Scene& scene, const System& layout) {
  SystemSweepParameters out;
  static_cast<SystemStaticParameters&>(out) = static_parameters_of(scene, layout);
  static_cast<MotionSettings&>(out) = motion_settings(scene);
  return out;
}

namespace {

// The gear of each body that is one, by its name.
void walk_gears(StageParameters& s, SystemStaticParameters& p) {
  StageParameters::Words words;
  for (size_t b = 0; b < p.gear.size(); ++b)
    if (!p.gear[b].empty()) words.emplace_back(p.layout.bodies[b].name, p.gear[b]);
  s.words("gear_of", words);
  const Source* const source = s.source();
  if (!source) return;
  const std::vector<std::string> gears = p.gears();
  for (const System::Body& body : p.layout.bodies) {
    std::string& own = p.gear.emplace_back();
    if (body.kind == System::BodyKind::carrier) continue;
    for (const auto& [name, gear] : words)
      if (name == body.name) own = gear;
    if (std::find(gears.begin(), gears.end(), own) == gears.end())
      source->reject("[gear_of] names no gear for the body '", body.name, "'");
  }
  try {
    p.section = sections_of(p.mesh, p.gear, p.layout);
  } catch (const Error& error) {
    source->reject(error.what());
  }
}

// moving: of what moves; speeds: of a motion over speeds.
void walk(StageParameters& s, SystemStaticParameters& p, MotionSettings* moving, bool speeds) {
  const bool reads = s.source();
  if (reads) {  // by their names sections are called
    walk(s, p.layout);
    s.words("bodies", p.body);
    p.errors.resize(p.layout.bodies.size());
  }
  for (size_t m = 0; (reads && m == 0) || s.has(text("mesh_", m), m < p.mesh.size()); ++m) {
    if (reads) p.mesh.emplace_back();
    const KeyList own = keys(p.mesh[m]).section("mesh");
    s(own.without({"misalignment_um", "face_offset_mm"})
          .all()
          .append(own.only({"misalignment_um"}))
          .labelled(text("mesh_", m)));
  }
  if (Friction friction = p.friction(); s.has("friction", friction.acts())) {
    s(keys(friction));
    p.set_friction(friction);
  }
  for (const auto& [gear, hash] : p.body) {
    FlankModification own = p.modification(gear);
    if (s.has("modification_" + gear, own.of_profile())) s(keys(own).labelled("modification_" + gear));
    if (s.has("lead_" + gear, !own.lead.none())) s(keys(own.lead).labelled("lead_" + gear));
    p.modify(gear, own);
  }
  for (size_t b = 0; b < p.errors.size(); ++b)
    if (const std::string label = "error_" + p.layout.bodies[b].name; s.has(label, p.has_errors(b)))
      s(keys(p.errors[b]).labelled(label));
  if (moving) {
    KeyList own = keys(moving->damping);
    if (speeds) own.append(speeds_key(*moving));
    s(own);
  }
  s(level_keys(p.fidelity, p.contact, moving ? &moving->time : nullptr));
  if (!reads) s.words("bodies", p.body);
  walk_gears(s, p);
  if (!reads) walk(s, p.layout);
}

}  // namespace

namespace {

std::string system_motion_text(SystemSweepParameters p, const StageFile& file, bool speeds) {
  StageParameters out(file);
  walk(out, p, &p, speeds);
  return out.text();
}

SystemSweepParameters read_system_motion(const std::string& path, const StageFile& file, bool speeds) {
  const Source source = stage_source(path, file);
  StageParameters in(source);
  SystemSweepParameters out;
  walk(in, out, &out, speeds);
  return out;
}

}  // namespace

std::string system_static_parameters(const SystemStaticParameters& p) {
  SystemStaticParameters copy = p;
  StageParameters out(kSystemStatic);
  walk(out, copy, nullptr, false);
  return out.text();
}

std::string system_sweep_parameters(const SystemSweepParameters& p) {
  return system_motion_text(p, kSystemSweep, true);
}

std::string system_impact_parameters(const SystemSweepParameters& p) {
  return system_motion_text(p, kSystemImpact, false);
}

SystemStaticParameters read_system_static_parameters(const std::string& path) {
  const Source source = stage_source(path, kSystemStatic);
  StageParameters in(source);
  SystemStaticParameters out;
  walk(in, out, nullptr, false);
  return out;
}

SystemSweepParameters read_system_sweep_parameters(const std::string& path) {
  return read_system_motion(path, kSystemSweep, true);
}

SystemSweepParameters read_system_impact_parameters(const std::string& path) {
  return read_system_motion(path, kSystemImpact, false);
}

std::string system_variant_parameters(const Scene& scene, const System& layout,
                                      const std::vector<Direction>& directions) {
  SystemSweepParameters p = sweep_parameters_of(scene, layout);
  StageParameters out(kSystemVariant);
  walk(out, p, directions.empty() ? nullptr : &p, true);
  std::string words = names_of(directions);
  out.word("variant", "directions", words);
  return out.text();
}

VariantParameters read_system_variant_parameters(const std::string& path) {
  const Source source = stage_source(path, kSystemVariant);
  StageParameters in(source);
  VariantParameters out;
  std::string words;
  in.word("variant", "directions", words);
  const auto directions = choices_in<Direction>(words);
  if (!directions) source.reject("names the directions '", words, "'; there are up and down");
  out.directions = *directions;
  walk(in, out.train, out.directions.empty() ? nullptr : &out.train, true);
  return out;
}

}  // namespace whine
