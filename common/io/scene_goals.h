// Whether a scene has what the goals of make ask for (model/capabilities.h).
#pragma once
#include <string>
#include <vector>

#include "model/capabilities.h"
#include "model/scene.h"
#include "model/system.h"

namespace whine {

// layout: layout_in() of io/scene.h.
Traits traits(const Scene& scene, const System& layout);

// path: as SCENE gives it. Error(input) names the first goal that the scene cannot reach, and what there is instead.
void check_goals(const std::vector<std::string>& goals, const Traits& scene, const std::string& path);

// What make asks of a scene, judged before anything is computed.
struct SceneRequest {
  std::vector<std::string> goals;
  std::string axis;  // AXIS, "rpm:sun": a gear or carrier that turns; "": the mesh frequency
  std::string mesh;  // MESH, "sun-planet1"; "": the first
  double at = 0;     // AT, Hz: one of the speeds of the scene; 0: none is asked for
};

// check_goals(), and Error for an axis that no body gives, for a mesh that is none, and for a speed that the sweeps do not have, with the
// nearest one.
void check_asked(const SceneRequest& asked, const Scene& scene, const System& layout,
                 const std::string& path);

}  // namespace whine
