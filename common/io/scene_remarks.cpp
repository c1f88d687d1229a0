#include "io/scene_remarks.h"

#include "base/error.h"
#include "base/format.h"
#include "dynamics/dynamics.h"
#include "gear/rack_tip.h"
#include "gear/scene_cost.h"
#include "gear/scene_geometry.h"
#include "io/scene_goals.h"
#include "io/scene_place.h"
#include "io/system_scene.h"
#include "system/near_interference.h"
#include "system/undamped_depth.h"

namespace whine {
namespace {

using Lines = std::vector<std::string>;

ScenePlace place_in(const std::string& path) {
  return
      [path](const auto& sections, const std::string& words) { return scene_place(path, sections, words); };
}

// Defaults that are not what the table of keys says, since that does not fit.
template <class AnyScene>
void add_defaults(const AnyScene& scene, const std::string& path, Lines& out) {
  for (const auto& gear : scene.gears) {
    const double radius = gear.design.rack_tip_radius;
    const std::string section = "gear." + gear.name;
    if (radius == kStandardRackTip || scene_gives(path, section, "rack_tip_radius")) continue;
    out.push_back(text("note: ", scene_place(path, {section}, ""), ": [", section,
                       "]: rack_tip_radius = ", shown_number(radius), " in place of the default ",
                       kStandardRackTip, ", which does not fit ",
                       gear.design.internal ? "the space between its teeth" : "the tooth of its rack",
                       " (largest ", shown_number(largest_rack_tip_radius(gear.design)), ")"));
  }
}

template <class AnyScene>
void add_of_gears_and_damping(const AnyScene& scene, const std::string& path, Lines& out) {
  for (const std::string& warning : scene_warnings(scene, place_in(path)))
    out.push_back("warning: " + warning);
  const std::string damping =
      beyond_relaxation_range(scene.damping, scene.fidelity.body, scene.operation.frequency_to);
  if (!damping.empty())
    out.push_back("warning: " + scene_place(path, {"damping"}, damping) +
                  ": motions are rejected: " + damping);
  for (const std::string& remark : scene_remarks(scene)) out.push_back(path + ": " + remark);
}

}  // namespace

void check_scene(const Scene& scene, const std::string& path) {
  const ScenePlace where = place_in(path);
  check_geometry(scene, where);
  check_inertia(scene, where);
  check_undamped_depth(scene, where);
  if (const std::string words = near_interference(scene, ForceBound::least); !words.empty())
    fail(Failure::input, where({"mesh"}, ""), ": [[mesh]]: ", words);
}

void check_scene(const SystemScene& scene, const System& layout, const std::string& path) {
  const ScenePlace where = place_in(path);
  check_system_geometry(scene, where);
  check_inertia(scene, where);
  check_at_rest_in(scene, layout, path);
  check_undamped_depth(scene, layout, where);
}

Lines scene_lines(const Scene& scene, const std::string& path) {
  Lines out;
  add_defaults(scene, path, out);
  if (const std::string words = near_interference(scene, ForceBound::largest); !words.empty())
    out.push_back("warning: " + scene_place(path, {"mesh"}, "") + ": statics may find that " + words);
  add_of_gears_and_damping(scene, path, out);
  const Traits of = traits(scene);
  if (const auto& [level, why] = of[0];
      level == Trait::pair_of_bodies && !scene_gives(path, "fidelity", "width"))
    out.push_back(text("note: ", path, ": ", why,
                       ", so width = \"body\" in [fidelity]: bodies in three dimensions, at rest; ",
                       "motion needs width = \"slices\""));
  for (const std::string& cost : costs(scene)) out.push_back(path + ": " + cost);
  return out;
}

Lines scene_lines(const SystemScene& scene, const System& layout, const std::string& path) {
  Lines out;
  add_defaults(scene, path, out);
  if (!scene.rigid())
    for (const auto& [section, words] : near_interferences(scene, layout, ForceBound::largest))
      out.push_back(text("warning: ", path, ": [[mesh]] of '", scene.meshes[section].spec.gear[0], "' and '",
                         scene.meshes[section].spec.gear[1], "': statics may find that ", words));
  add_of_gears_and_damping(scene, path, out);
  for (const std::string& cost : costs(scene)) out.push_back(path + ": " + cost);
  for (const std::string& remark : motion_remarks(scene)) out.push_back(remark);
  return out;
}

}  // namespace whine
