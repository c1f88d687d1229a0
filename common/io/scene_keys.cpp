#include "io/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "io/keys.h"

namespace whine {
namespace {

// What an artifact says to the keys of a scene, from the side of one of its gears.
struct View {
  GearDesign design;
  GearWords words;
  FlankModification modification;
  ToothErrors errors;
  Material material;
  GearMeshSpec mesh;
  Bearing bearing;
  Damping damping;
  Fidelity fidelity;
  BodyDiscretisation body;
  ContactDiscretisation contact;
  TimeDiscretisation time;
};

// m: d_a = m (z / cos beta + 2 x + 2 h_a), d_f = m (z / cos beta + 2 x - 2 h_f); of an internal gear, whose tips lie inside, with the other signs.
void set_drawing(View& view, const BodyParameters& drawing) {
  view.design = drawing.design;
  view.material = drawing.material;
  view.body = drawing.discretisation;
  const GearDesign& gear = view.design;
  const double outwards = gear.internal ? -1 : 1,
               middle = gear.teeth / std::cos(gear.helix_angle) + outwards * 2 * gear.profile_shift;
  view.words.tip_diameter = gear.module * (middle + outwards * 2 * gear.addendum);
  view.words.root_diameter = gear.module * (middle - outwards * 2 * gear.dedendum);
}

// It need not know of motion.
template <class Artifact>
View view_of(const Artifact& a, int g) {
  View view;
  view.mesh = a.mesh;
  view.contact = a.contact;
  view.fidelity = a.fidelity;
  set_drawing(view, a.gear[g]);
  view.modification = a.mesh.modification[g];
  view.errors = a.mesh.errors[g];
  view.bearing = a.mesh.bearing[g];
  if constexpr (requires { a.damping; }) {
    view.time = a.time;
    view.damping = a.damping;
    view.words.total_inertia = a.inertia[g];
  }
  return view;
}

// A key, and whether the artifact says something of it.
struct GearRow {
  Key key;
  bool stands;
};

// In the order of scenes. Title, names of other sections, torques and speeds are no properties of what was computed.
std::vector<GearRow> rows_of(View& v, bool moves) {
  std::vector<GearRow> out;
  const auto add = [&](const KeyList& list, bool stands) {
    for (const Key& key : list) out.push_back({key, stands && is_held(key)});
  };
  const KeyList gear = keys(v.design, &v.words).without({"like", "material"});
  add(gear.section("gear"), true);
  add(keys(v.modification), v.modification.of_profile());
  add(keys(v.modification.lead), !v.modification.lead.none());
  add(keys(v.errors), !v.errors.none());
  add(gear.section("crack"), true);
  add(keys(v.material), true);
  add(keys(v.mesh).section("mesh").without({"misalignment_um", "face_offset_mm"}).all(), true);
  add(keys(v.mesh).section("mesh").only({"misalignment_um", "face_offset_mm"}), true);
  add(keys(v.bearing), v.bearing.elastic());
  add(keys(v.mesh.friction), v.mesh.friction.acts());
  add(keys(v.damping), moves);
  add(keys(v.fidelity), moves);
  add(keys(v.body).all(), true);
  add(keys(v.contact), true);
  add(keys(v.time), moves);
  for (GearRow& row : out) {
    if (row.key.called("total_inertia_kgm2")) row.stands = moves;
    if (row.key.section == std::string("fidelity") && row.key.called("contact")) row.stands = true;
  }
  return out;
}

// As a scene would have it; "" for a list that is empty.
std::string in_scene_unit(const Key& key) {
  const std::string word = value_text(
      key,
      [](double si, const Unit& unit) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.6g", si * unit.divide / unit.multiply);
        return std::string(buffer);
      },
      "");
  return word == "[]" ? "" : word;
}

// Of the gears of a pair, or of a train, whose friction and meshes stand apart. A section that one gear of a pair has is told of both.
SceneKeys keys_of_views(std::vector<std::string> gears, std::vector<View> views, bool moves, bool train) {
  std::vector<std::vector<GearRow>> of;
  of.reserve(views.size());
  for (View& view : views) of.push_back(rows_of(view, moves));
  const bool modified = std::any_of(
      views.begin(), views.end(), [](const View& view) { return view.modification != FlankModification{}; });
  SceneKeys out{std::move(gears), {}};
  for (size_t i = 0; !of.empty() && i < of.front().size(); ++i) {
    const Key& key = of.front()[i].key;
    SceneKeys::Row row{key.section, key.name, {}, key.meaning};
    const auto in = [&](auto... names) { return ((row.section == names) || ...); };
    if (train && (in("mesh", "friction") || of_pairs(key))) continue;
    const bool any = std::any_of(of.begin(), of.end(), [&](const auto&gear) { return gear[i].stands; }),
               both = train ? (in("modification") && modified) || key.called("total_inertia_kgm2") : any;
    row.value.reserve(of.size());
    for (const std::vector<GearRow>& gear : of)
      row.value.push_back(both || (train && gear[i].stands) ? in_scene_unit(gear[i].key) : "");
    const auto all = [&](const std::string& word) {
      return std::all_of(row.value.begin(), row.value.end(), [&](const auto& own) { return own == word; });
    };
    if (all("")) continue;
    if (all(row.value.front()) && in("mesh", "friction", "damping", "fidelity", "discretisation"))
      row.value.resize(1);
    out.rows.push_back(row);
  }
  return out;
}

template <class Artifact>
SceneKeys keys_of_pair(const Artifact& a) {
  return keys_of_views(
      {a.mesh.gear.begin(), a.mesh.gear.end()}, {view_of(a, 0), view_of(a, 1)}, requires { a.damping; },
      false);
}

// One of the gears of a system, and what all of its meshes have in common.
View view_of(const SystemStaticResult& a, size_t g, const MotionSource* moving) {
  View view;
  const std::string& name = a.settings.body[g].first;
  set_drawing(view, a.drawing[g]);
  view.modification = a.settings.modification(name);
  for (size_t b = a.settings.gear.size(); b-- > 0;)  // of planets the first
    if (a.settings.gear[b] == name) {
      if (a.settings.has_errors(b)) view.errors = a.settings.errors[b];
      view.bearing = a.settings.layout.bodies[b].bearing;
      view.words.total_inertia = a.settings.layout.bodies[b].inertia;
    }
  view.fidelity = moving ? moving->fidelity : a.settings.fidelity;
  view.contact = a.settings.contact;
  if (moving) {
    view.damping = moving->damping;
    view.time = moving->time;
  }
  return view;
}

}  // namespace

SceneKeys scene_keys_of(const StaticResult& a) {
  return keys_of_pair(a);
}

SceneKeys scene_keys_of(const ResponseResult& a) {
  return keys_of_pair(a);
}

SceneKeys scene_keys_of(const SystemStaticResult& a, const MotionSource* moving) {
  std::vector<View> views;
  views.reserve(a.settings.body.size());
  for (size_t g = 0; g < a.settings.body.size(); ++g) views.push_back(view_of(a, g, moving));
  SceneKeys out = keys_of_views(a.settings.gears(), std::move(views), moving != nullptr, true);
  if (Friction friction = a.settings.friction(); friction.acts())
    for (const Key& key : keys(friction))
      out.rows.push_back({"friction", key.name, {in_scene_unit(key)}, key.meaning});
  for (GearMeshSpec mesh : a.settings.mesh)
    for (const Key& key : keys(mesh).section("mesh").without({"driver", "driven"}))
      out.rows.push_back(
          {text("mesh ", mesh.gear[0], "-", mesh.gear[1]), key.name, {in_scene_unit(key)}, key.meaning});
  return out;
}

std::string changed_keys(const JumpMapResult& from, const JumpMapResult& to) {
  const auto changes = [&](int g) {
    View old = view_of(from, g), fresh = view_of(to, g);
    const std::vector<GearRow> before = rows_of(old, true), after = rows_of(fresh, true);
    std::string out;
    for (size_t i = 0; i < before.size(); ++i) {
      const Key& key = before[i].key;
      if (key.called("tip_diameter_mm") || key.called("root_diameter_mm")) continue;
      const std::string a = in_scene_unit(key), b = in_scene_unit(after[i].key);
      if (a != b) out += text(out.empty() ? "" : ", ", key.name, " ", a, " → ", b);
    }
    return out;
  };
  const std::string driver = changes(0), driven = changes(1);
  if (driver == driven) return driver;
  return text("driver: ", driver, "; driven: ", driven);
}

}  // namespace whine
