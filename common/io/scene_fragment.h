// What make has to know of a scene S, as a fragment of a makefile:
//
//   SCENE_S_KIND         pair, train or rigid: several meshes, carriers or drives, of elastic gears or of rigid ones
//   SCENE_S_GEARS, SCENE_S_BODY_<gear> (hash), BODIES        of elastic gears
//   SCENE_S_TORQUES, SCENE_S_REFERENCE_TORQUE                N m; of a train that of its input
//   SCENE_S_MOVES        yes: it has speeds
//
// and of a pair:
//
//   SCENE_S_DRIVER, SCENE_S_DRIVEN
//   SCENE_S_RINGS_DOWN   no: with its [fidelity], or its teeth, there is no gear-impact
//   SCENE_S_TEETH        alike, or differ and cracked
//   SCENE_S_MODIFIED     yes: flanks are not as designed
//   SCENE_S_BEARINGS     rigid or elastic
//   SCENE_S_FRICTION     yes or no
//
// and of a train:
//
//   SCENE_S_PLANETS      yes: a [[mesh]] stands for those of several
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/scene.h"

namespace whine {

using BodyHashes = std::vector<
    std::pair<std::string, std::string>>;  // gear, hash of its stage parameters; in the order of the scene

// Writes <folder>/bodies/<hash>/body.toml of each gear, and the links <home>/<gear> to them.
BodyHashes publish_bodies(const std::string& home, const std::string& folder, const BodySettings& settings);

// The hashes, each once.
std::vector<std::string> different(const BodyHashes& bodies);

// Name of a scene's file without folder and extension: it names a folder, a make variable and a goal. Error(input) if it cannot.
std::string checked_scene_stem(const std::string& path);

// What names the folder of a system's results, N m: of its first drive whose torque turns it on, else of the first one the magnitude; 0
// without any.
double input_torque(const System& layout);

// path: of the scene; stem: its name without folder and extension, which the variables carry; layout: layout_in(); bodies: of elastic
// gears, empty of rigid ones.
std::string scene_fragment(const Scene& scene, const System& layout, const std::string& path,
                           const std::string& stem, const BodyHashes& bodies);

}  // namespace whine
