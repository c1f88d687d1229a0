// The key numbers of an artifact in the units that an engineer reads, for gear-inspect.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/scene.h"

namespace whine {

// "as designed", "tip relief 10 um from 20.9 deg".
std::string in_words(const FlankModification& modification);

// What every line of a summary is in; a number that stands without a unit is a plain one.
inline constexpr const char* kSummaryUnits =
    "units: mm (gears), µm (displacements, gaps), N, N m, N/µm, MPa, Hz, kg, kg m2, µs (eta), % of ratios; "
    "others at the number";

// Name and text of each number; schema as read_origin gives it. Errors as the reader of that schema.
std::vector<std::pair<std::string, std::string>> summary(const std::string& path, const std::string& schema);

// "file: title" of the scene in whose folder an artifact stands, by the title.txt that gear-scene writes; the file alone if
// that is its title, "" if no folder above the artifact is a scene's. One line of 160 characters at most.
std::string scene_words(const std::string& path);

// The file alone: what designs side by side are called by. Throws Error(input) for an artifact in no folder of a scene.
std::string design_name(const std::string& path);

}  // namespace whine
