#include "model/scene.h"

#include "base/error.h"

namespace whine {

const SceneGear& Scene::gear(const std::string& name) const {
  for (const SceneGear& candidate : gears) {
    if (candidate.name == name) return candidate;
  }
  fail(Failure::input, "the scene has no gear '", name, "'");
}

}  // namespace whine
