// Whether a scene has what the goals of make ask for.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "model/system.h"
#include "model/system_scene.h"

namespace whine {

struct SceneAbilities {
  bool pair = true;
  bool teeth_differ = false, cracked = false;
  std::string face = {};  // what one slice over the face does not hold, in words; "": nothing
  bool slices = false;    // its contact is in slices over the face
  bool elastic = false, planets = false, moves = false;  // of a system
  bool pair_moves() const { return face.empty() || slices; }
};
SceneAbilities abilities(const Scene& scene);
SceneAbilities abilities(const SystemScene& scene, const System& layout);

// path: as SCENE gives it. Error(input) names the first goal that the scene cannot reach, and what there is instead.
void check_goals(const std::vector<std::string>& goals, const SceneAbilities& scene, const std::string& path);

}  // namespace whine
