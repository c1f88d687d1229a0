// What is judged of a whole scene before anything is computed. Errors and lines say where in the file they are from.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "model/system.h"

namespace whine {

// Throws Error(input) for gears that cannot exist or run together, and for contacts that statics would reject. layout: layout_in().
void check_scene(const Scene& scene, const System& layout, const std::string& path);

// What to know of a scene that passes, a line each: defaults that do not fit, what statics or motions may reject, faces of
// unequal width, what takes long.
std::vector<std::string> scene_lines(const Scene& scene, const System& layout, const std::string& path);

}  // namespace whine
