// A scene in which some keys have other values, for studies of what an input is worth.
#pragma once
#include <string>
#include <vector>

namespace whine {

// The scene file `path` as TOML with every change "key=value" in it; keys as in the table of scene keys, values as in a
// scene, words with or without quotes. A key of gears or materials changes in every one of them that does not take it over
// by `like`. What the values mean is checked when the scene is read. Throws Error(usage) for a change without '=' or a key
// that no scene has, by its nearest known name, Error(input) if the scene is not valid TOML or lacks the section.
std::string scene_variant(const std::string& path, const std::vector<std::string>& changes);

}  // namespace whine
