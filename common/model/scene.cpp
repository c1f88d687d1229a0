#include "model/scene.h"

namespace whine {

const SceneGear& Scene::gear(const std::string& name) const {
  for (const SceneGear& candidate : gears) {
    if (candidate.name == name) return candidate;
  }
  fail(Failure::input, "the scene has no gear '", name, "'");
}

std::vector<GearMeshSpec> Scene::specs() const {
  std::vector<GearMeshSpec> out;
  out.reserve(meshes.size());
  for (const Mesh& own : meshes) out.push_back(own.spec);
  return out;
}

}  // namespace whine
