#include "io/scene_remarks.h"

#include "base/error.h"
#include "base/format.h"
#include "dynamics/dynamics.h"
#include "gear/rack_tip.h"
#include "gear/scene_cost.h"
#include "gear/scene_geometry.h"
#include "io/scene.h"
#include "io/scene_goals.h"
#include "io/scene_place.h"
#include "system/near_interference.h"
#include "system/rigid_system.h"
#include "system/undamped_depth.h"

namespace whine {
namespace {

using Lines = std::vector<std::string>;

ScenePlace place_in(const std::string& path) {
  return
      [path](const auto& sections, const std::string& words) { return scene_place(path, sections, words); };
}

// Defaults that are not what the table of keys says, since that does not fit.
void add_defaults(const Scene& scene, const std::string& path, Lines& out) {
  for (const SceneGear& gear : scene.gears) {
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

}  // namespace

void check_scene(const Scene& scene, const System& layout, const std::string& path) {
  if (scene.rigid()) return static_cast<void>(rigid_system(layout));
  const ScenePlace where = place_in(path);
  check_geometry(scene, where);
  check_inertia(scene, where);
  check_at_rest_in(scene, layout, path);
  check_undamped_depth(scene, layout, where);
}

Lines scene_lines(const Scene& scene, const System& layout, const std::string& path) {
  Lines out;
  add_defaults(scene, path, out);
  if (!scene.rigid())
    for (const auto& [section, words] : near_interferences(scene, layout, ForceBound::largest)) {
      const auto& [driver, driven] = scene.meshes[section].spec.gear;
      out.push_back(text("warning: ", scene.pair() ? scene_place(path, {"mesh"}, "") : path,
                         ": [[mesh]] of '", driver, "' and '", driven, "': statics may find that ", words));
    }
  for (const std::string& warning : scene_warnings(scene, place_in(path)))
    out.push_back("warning: " + warning);
  const std::string damping =
      beyond_relaxation_range(scene.damping, scene.fidelity.body, scene.operation.frequency_to);
  if (!damping.empty())
    out.push_back("warning: " + scene_place(path, {"damping"}, damping) +
                  ": motions are rejected: " + damping);
  for (const std::string& remark : scene_remarks(scene)) out.push_back(path + ": " + remark);
  const Traits of = traits(scene, layout);
  if (const auto& [level, why] = of[0];
      level == Trait::pair_of_bodies && !scene_gives(path, "fidelity", "width"))
    out.push_back(text("note: ", path, ": ", why,
                       ", so width = \"body\" in [fidelity]: bodies in three dimensions, at rest; ",
                       "motion needs width = \"slices\""));
  for (const std::string& cost : costs(scene)) out.push_back(path + ": " + cost);
  for (const std::string& remark : motion_remarks(scene)) out.push_back(remark);
  return out;
}

}  // namespace whine
