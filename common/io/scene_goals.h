// Whether a scene has what the goals of make ask for (model/capabilities.h).
#pragma once
#include <string>
#include <vector>

#include "model/capabilities.h"
#include "model/scene.h"
#include "model/system.h"
#include "model/system_scene.h"

namespace whine {

Traits traits(const Scene& scene);
Traits traits(const SystemScene& scene, const System& layout);

// path: as SCENE gives it. Error(input) names the first goal that the scene cannot reach, and what there is instead.
void check_goals(const std::vector<std::string>& goals, const Traits& scene, const std::string& path);

}  // namespace whine
