// Where in a scene file a thing stands, for errors that are found when the file has long been read.
#pragma once
#include <string>
#include <vector>

namespace whine {

// "pair.toml:17": the line of the first key that `words` name among those of `sections` ("gear.pinion", "mesh"; one section
// after the other), a key that a gear takes over by `like` included; if there is none, the line at which the first section
// begins; the path alone if the file cannot be read or lacks it.
std::string scene_place(const std::string& path, const std::vector<std::string>& sections,
                        const std::string& words);

// Whether a section ("gear.pinion") of a scene that has been read gives a key, a gear itself or by `like`.
bool scene_gives(const std::string& path, const std::string& section, const std::string& key);

}  // namespace whine
