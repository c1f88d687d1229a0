#include "io/scene_goals.h"

#include <algorithm>

#include "base/error.h"

namespace whine {

Traits traits(const Scene& scene) {
  Traits out = traits(scene.mesh, scene.gear(scene.mesh.gear[0]).design,
                      scene.gear(scene.mesh.gear[1]).design, scene.fidelity.width);
  const auto lacks = [&](bool trait, Trait without) {
    if (!trait) out.emplace_back(without, "");
  };
  const bool cracked = has(out, Trait::cracked);
  lacks(!has(out, Trait::pair), Trait::one_slice);
  lacks(has(out, Trait::friction), Trait::no_friction);
  lacks(has(out, Trait::bearings), Trait::no_bearings);
  if (cracked) out.emplace_back(Trait::unlike_pair, "");
  for (const std::string& gear : scene.mesh.gear)
    if (!scene.gear(gear).errors.none())
      for (const Trait own : {Trait::unlike_pair, Trait::differing})
        out.emplace_back(own, "[gear." + gear + ".error]");
  lacks(cracked, Trait::no_crack);
  lacks(has(out, Trait::differing), Trait::no_errors);
  lacks(cracked || has(out, Trait::differing), Trait::like_teeth);
  return out;
}

Traits traits(const SystemScene& scene, const System& layout) {
  const bool slices = scene.fidelity.width != WidthModel::one;
  Traits out{{scene.rigid() ? Trait::rigid_gears
              : slices      ? Trait::train_in_slices
                            : Trait::train,
              slices ? text("[fidelity] has width = \"", scene.fidelity.width, "\"") : ""}};
  if (!(scene.operation.frequency_to > 0))
    out.emplace_back(Trait::no_speeds,
                     "[operation] mesh_frequency_Hz = { from = 500, to = 5000, step = 50 }");
  if (layout.meshes.size() <= scene.meshes.size()) out.emplace_back(Trait::no_planets, "");
  for (const SystemScene::Gear& gear : scene.gears) {
    if (!gear.errors.none()) out.emplace_back(Trait::differing, "[gear." + gear.name + ".error]");
    if (gear.design.crack.depth > 0) out.emplace_back(Trait::cracked, "[gear." + gear.name + ".crack]");
  }
  if (!slices) out.emplace_back(Trait::one_slice, "");
  if (!has(out, Trait::differing) && !has(out, Trait::cracked)) out.emplace_back(Trait::like_teeth, "");
  return out;
}

void check_goals(const std::vector<std::string>& goals, const Traits& scene, const std::string& path) {
  const std::string which = "SCENE=" + path;
  std::string instead;  // "report, or of it static ..."
  int many = 0;
  for (const std::string& goal : known_goals())
    if (not_taken(goal, scene).empty())
      instead += (++many == 1 ? "" : many == 2 ? ", or of it " : " ") + goal;
  for (const std::string& goal : goals)
    if (const std::string words = refusal(goal, scene); !words.empty())
      fail(Failure::input, which, ": ", words, "; for it there is: make ", which, " ", instead);
}

}  // namespace whine
