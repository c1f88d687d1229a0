// A scene in which some keys have other values, for studies of what an input is worth.
#pragma once
#include <string>
#include <vector>

#include "io/scene.h"

namespace whine {

// The scene file `path` as TOML with every change "key=value" in it; keys as in the table of scene keys, values as in a
// scene, words with or without quotes. A key alone, "bore_radius_mm", changes in every gear or material that does not take it
// over by `like`; by its place, "gear.pinion.bore_radius_mm", in that one, as if it were edited there: gears that are `like` it
// follow. Of trains: "drive.sun.torque_Nm", "mesh.sun-planet.centre_distance_mm", "carrier.<name>.", "pin.planet2.tangential_um",
// whose [[pin]] is added where it lacks. What the values mean is checked when the scene is read. Throws Error(usage) for a change without '=' or a key
// that no scene has, by its nearest known name, Error(input) if the scene is not valid TOML or lacks the section, the gear or
// the material.
std::string scene_variant(const std::string& path, const std::vector<std::string>& changes);

// read_scene of `variant`, which is the scene `path` with changes; errors name no line, because those of the file are others.
Scene read_variant_of(const std::string& path, const std::string& variant);

// Letters, digits, '_' and '-': what may be the name of a section of a scene, of a folder and of a goal of make.
bool plain_name(const std::string& name);

// Of a gear or a scene, in letters: with what stands behind it, it is the name of a folder or a file.
inline constexpr size_t kLongestName = 100;

// Whether what is made of a scene beside the folders of its gears stands in a folder of this name.
bool is_folder_of_results(const std::string& name);

}  // namespace whine
