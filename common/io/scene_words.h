// What the scene of an artifact is called, by the folder in which the artifact stands.
#pragma once
#include <string>

namespace whine {

// "file: title" of the scene in whose folder an artifact stands, by the title.txt that gear-scene writes; the file alone if
// that is its title, "" if no folder above the artifact is a scene's. One line of 160 characters at most.
std::string scene_words(const std::string& path);

// The file alone: what designs side by side are called by. Throws Error(input) for an artifact in no folder of a scene.
std::string design_name(const std::string& path);

}  // namespace whine
