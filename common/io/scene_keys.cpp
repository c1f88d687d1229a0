#include "io/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.h"
#include "io/keys.h"

namespace whine {
namespace {

// m: d_a = m (z + 2 x + 2 h_a), d_f = m (z + 2 x - 2 h_f); of an internal gear, whose tips lie inside, with the other signs.
void diameters_as_heights(SceneParameters& values) {
  const GearDesign& gear = values.design;
  const double outwards = gear.internal ? -1 : 1, middle = gear.teeth + outwards * 2 * gear.profile_shift;
  values.tip_diameter = gear.module * (middle + outwards * 2 * gear.addendum);
  values.root_diameter = gear.module * (middle - outwards * 2 * gear.dedendum);
}

// What an artifact of a pair says to the keys of a scene, from the side of one of its gears. It need not know of motion.
template <class Artifact>
SceneParameters keys_of(const Artifact& a, int g) {
  SceneParameters values;
  values.mesh = a.mesh;
  values.contact = a.contact;
  values.fidelity = a.fidelity;
  if constexpr (requires { a.damping; }) {
    values.time = a.time;
    values.damping = a.damping;
  }
  values.design = a.gear[g].design;
  diameters_as_heights(values);
  values.material = a.gear[g].material;
  values.body = a.gear[g].discretisation;
  take_gear(values, a.mesh, g);
  if constexpr (requires { a.damping; }) values.total_inertia = a.inertia[g];
  return values;
}

// As a scene would have it; "" for a list that is empty.
std::string in_scene_unit(SceneParameters& values, const Key& key) {
  const auto number = [](double si, const Unit& unit) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", si * unit.divide / unit.multiply);
    return std::string(buffer);
  };
  std::string list;
  const Slot slot = key.slot(values);
  if (const auto* one = std::get_if<double*>(&slot)) return number(**one, key.unit);
  if (const auto* whole = std::get_if<int*>(&slot)) return text(**whole);
  if (const auto* word = std::get_if<std::string*>(&slot)) return **word;
  if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) return key.word_in(*choice);
  if (const auto* flag = std::get_if<bool*>(&slot)) return **flag ? "true" : "false";
  if (const auto* plane = std::get_if<PlaneSlot>(&slot)) return *plane->stress ? "stress" : "strain";
  if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    if (!(*corner)->enabled) return "false";
    return std::isinf((*corner)->largest_angle) ? "true"
                                                : text((*corner)->largest_angle * 180 / std::numbers::pi);
  }
  if (const auto* points = std::get_if<Points*>(&slot))
    for (const auto& [roll, removed] : **points)
      list += text(list.empty() ? "" : ", ", "[", number(roll, kPointUnits[0]), ", ",
                   number(removed, kPointUnits[1]), "]");
  if (const auto* teeth = std::get_if<ToothList>(&slot))
    for (const double value : *teeth->values) list += (list.empty() ? "" : ", ") + number(value, key.unit);
  return list.empty() ? "" : "[" + list + "]";
}

// Title, names of other sections, torques and speeds are no properties of what was computed.
bool of_operation(const Key& key) {
  return of_systems(key.part) || key.part == KeyGroup::title || key.part == KeyGroup::reference ||
         key.part == KeyGroup::error_file || key.part == KeyGroup::bearing_gear ||
         key.part == KeyGroup::load || key.part == KeyGroup::operation;
}

template <class Artifact>
std::vector<SceneKey> scene_keys_in(const Artifact& a) {
  SceneParameters driver = keys_of(a, 0), driven = keys_of(a, 1);
  const bool moves = requires {
    a.damping;
  };
  const auto stands = [&](KeyGroup part) {
    switch (part) {
      case KeyGroup::inertia:
      case KeyGroup::damping:
      case KeyGroup::level:
      case KeyGroup::time:
        return moves;
      case KeyGroup::bore:
        return !driver.design.internal || !driven.design.internal;
      case KeyGroup::rim:
        return driver.design.internal || driven.design.internal;
      case KeyGroup::rim_support:
        return driver.design.elastic_rim() || driven.design.elastic_rim();
      case KeyGroup::friction:
        return driver.mesh.friction.acts();
      case KeyGroup::crack:
        return driver.design.crack.depth > 0 || driven.design.crack.depth > 0;
      default:
        break;
    }
    for (const GearSection& own : kGearSections)
      if (own.part == part) return own.stands(driver) || own.stands(driven);
    return true;
  };
  std::vector<SceneKey> out;
  for (const Key& key : scene_keys()) {
    if (of_operation(key) || !stands(key.part)) continue;
    const std::string section(key.section), first = in_scene_unit(driver, key),
                                            second = in_scene_unit(driven, key);
    const bool of_gears = section != "mesh" && section != "friction" && section != "damping" &&
                          section != "fidelity" && section != "discretisation";
    if (!first.empty() || !second.empty())
      out.push_back({section, key.name, {first, of_gears || first != second ? second : ""}, key.meaning});
  }
  return out;
}

}  // namespace

std::vector<SceneKey> scene_keys_of(const StaticResult& a) {
  return scene_keys_in(a);
}

std::vector<SceneKey> scene_keys_of(const ResponseResult& a) {
  return scene_keys_in(a);
}

namespace {

// Keys of one of the gears of a system, and what all of its meshes have in common.
SceneParameters keys_of(const SystemStaticResult& a, size_t g, const SystemSweepResult* moving) {
  SceneParameters values;
  const std::string& name = a.settings.body[g].first;
  values.design = a.drawing[g].design;
  diameters_as_heights(values);
  values.material = a.drawing[g].material;
  values.body = a.drawing[g].discretisation;
  values.modification = a.settings.modification(name);
  for (size_t b = a.settings.gear.size(); b-- > 0;)  // of planets the first
    if (a.settings.gear[b] == name) {
      if (a.settings.has_errors(b)) values.errors = a.settings.errors[b];
      values.bearing = a.settings.layout.bodies[b].bearing;
      values.total_inertia = a.settings.layout.bodies[b].inertia;
    }
  values.fidelity = a.settings.fidelity;
  values.contact = a.settings.contact;
  if (moving) {
    values.fidelity = moving->settings.fidelity;
    values.damping = moving->settings.damping;
    values.time = moving->settings.time;
  }
  return values;
}

}  // namespace

SystemKeys scene_keys_of(const SystemStaticResult& a, const SystemSweepResult* moving) {
  SystemKeys out;
  out.gears = a.settings.gears();
  std::vector<SceneParameters> of;
  of.reserve(out.gears.size());
  for (size_t g = 0; g < out.gears.size(); ++g) of.push_back(keys_of(a, g, moving));
  const auto stands = [&](const SceneParameters& gear, KeyGroup part) {
    switch (part) {
      case KeyGroup::bore:
        return !gear.design.internal;
      case KeyGroup::rim:
        return gear.design.internal;
      case KeyGroup::rim_support:
        return gear.design.elastic_rim();
      case KeyGroup::bearing:
        return gear.bearing.elastic();
      case KeyGroup::error:
        return !gear.errors.none();
      case KeyGroup::modification:
        return std::any_of(of.begin(), of.end(), [](const SceneParameters& one) {
          return one.modification != FlankModification{};
        });
      case KeyGroup::damping:
      case KeyGroup::level:
      case KeyGroup::time:
        return moving != nullptr;
      default:
        return !of_pairs(part) && part != KeyGroup::mesh && part != KeyGroup::contact_plane;
    }
  };
  for (const Key& key : scene_keys()) {
    if (of_operation(key)) continue;
    SystemKeys::Row row{key.section, key.name, {}, key.meaning};
    row.value.reserve(of.size());
    for (SceneParameters& gear : of)
      row.value.push_back(stands(gear, key.part) ? in_scene_unit(gear, key) : "");
    const bool alike = std::all_of(row.value.begin(), row.value.end(),
                                   [&](const std::string& value) { return value == row.value.front(); });
    const bool of_all =
        row.section == "damping" || row.section == "fidelity" || row.section == "discretisation";
    if (alike && of_all && !row.value.empty()) row.value.resize(1);
    const bool said = std::any_of(row.value.begin(), row.value.end(),
                                  [](const std::string& value) { return !value.empty(); });
    if (said) out.rows.push_back(row);
  }
  for (const GearMeshSpec& mesh : a.settings.mesh) {
    SceneParameters values;
    values.mesh = mesh;
    for (const Key& key : scene_keys())
      if (key.part == KeyGroup::contact_plane ||
          (key.part == KeyGroup::mesh && key.name != std::string("driver") &&
           key.name != std::string("driven")))
        out.rows.push_back({text("mesh ", mesh.gear[0], "-", mesh.gear[1]),
                            key.name,
                            {in_scene_unit(values, key)},
                            key.meaning});
  }
  return out;
}

std::string changed_keys(const JumpMapResult& from, const JumpMapResult& to) {
  const auto changes = [&](int g) {
    SceneParameters old = keys_of(from, g), fresh = keys_of(to, g);
    std::string out;
    for (const Key& key : scene_keys()) {
      if (of_operation(key) || key.part == KeyGroup::diameter) continue;
      const std::string a = in_scene_unit(old, key), b = in_scene_unit(fresh, key);
      if (a != b) out += text(out.empty() ? "" : ", ", key.name, " ", a, " → ", b);
    }
    return out;
  };
  const std::string driver = changes(0), driven = changes(1);
  if (driver == driven) return driver;
  return text("driver: ", driver, "; driven: ", driven);
}

}  // namespace whine
