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

// path: of the scene; stem: its name without folder and extension, which the variables carry.
std::string scene_fragment(const Scene& scene, const std::string& path, const std::string& stem,
                           const BodyHashes& bodies);

}  // namespace whine
