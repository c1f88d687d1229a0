// What make has to know of a scene, as a fragment of a makefile.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/scene.h"
#include "io/system_scene.h"

namespace whine {

using BodyHashes = std::vector<
    std::pair<std::string, std::string>>;  // gear, hash of its stage parameters; in the order of the scene

// Writes <folder>/bodies/<hash>/body.toml of each gear, and the links <home>/<gear> to them.
BodyHashes publish_bodies(const std::string& home, const std::string& folder, const BodySettings& settings);

// The hashes, each once.
std::vector<std::string> different(const BodyHashes& bodies);

// Name of a scene's file without folder and extension: it names a folder, a make variable and a goal. Error(input) if it cannot.
std::string checked_scene_stem(const std::string& path);

// Of a system; bodies: of elastic gears, empty of rigid ones; planets: whether a [[mesh]] stands for those of several; moves: it has
// speeds.
std::string system_fragment(const std::string& path, const std::string& stem, const BodyHashes& bodies,
                            bool planets, bool moves);

// path: of the scene; stem: its name without folder and extension, which the variables carry.
std::string scene_fragment(const Scene& scene, const std::string& path, const std::string& stem,
                           const BodyHashes& bodies);

}  // namespace whine
