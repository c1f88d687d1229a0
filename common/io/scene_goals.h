// Whether a scene has what the goals of make ask for.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "model/system.h"
#include "model/system_scene.h"

namespace whine {

struct SceneGoals {
  std::vector<std::string> of_pairs, of_systems;  // goals that are of one alone
};
struct SceneAbilities {
  bool pair = true;
  bool teeth_differ = false, cracked = false;            // of a pair
  bool elastic = false, planets = false, moves = false;  // of a system
};
SceneAbilities abilities(const Scene& scene);
SceneAbilities abilities(const SystemScene& scene, const System& layout);

// path: as SCENE gives it. Error(input) names the goal and what there is instead.
void check_goals(const SceneGoals& goals, const SceneAbilities& scene, const std::string& path);

}  // namespace whine
