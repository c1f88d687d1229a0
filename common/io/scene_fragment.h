// What make has to know of a scene, as a fragment of a makefile.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/scene.h"

namespace whine {

using BodyHashes = std::vector<
    std::pair<std::string, std::string>>;  // gear, hash of its stage parameters; in the order of the scene

// The hashes, each once.
std::vector<std::string> different(const BodyHashes& bodies);

// Name of a scene's file without folder and extension: it names a folder, a make variable and a goal. Error(input) if it cannot.
std::string checked_scene_stem(const std::string& path);

// Of a system.
std::string system_fragment(const std::string& path, const std::string& stem);

// path: of the scene; stem: its name without folder and extension, which the variables carry.
std::string scene_fragment(const Scene& scene, const std::string& path, const std::string& stem,
                           const BodyHashes& bodies);

}  // namespace whine
