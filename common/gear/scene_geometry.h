// Whether a scene's gears can exist and run together, told before minutes of work.
#pragma once
#include <string>

#include "files/scene.h"

namespace whine {

// Throws what ToothGeometry, crack_slit, FlankDeviation and GearPair throw, with `path` and the section of the scene before it.
void check_geometry(const Scene& scene, const std::string& path);

}  // namespace whine
