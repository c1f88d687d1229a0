// Scenes of systems (several meshes, carriers, drives), and the stage parameters that are cut from them.
#pragma once
#include <string>

#include "model/system_scene.h"

namespace whine {

// Whether a scene is one of a system; false if it cannot be read or is no TOML.
bool is_system_scene(const std::string& path);

// Errors as read_scene.
SystemScene read_system_scene(const std::string& path);

// layout_of(scene), with file:line of the section that is wrong.
System layout_in(const SystemScene& scene, const std::string& path);

// Canonical text of the stage parameters of the modes of a system, and back: bodies, meshes and drives as they stand, in SI.
std::string system_parameters(const System& layout);
System read_system_parameters(const std::string& path);

}  // namespace whine
