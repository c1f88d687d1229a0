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
    "units: mm (gears), µm (displacements, gaps), N, N m, N/µm, MPa, Hz, kg, kg m2, µs (eta), % of ratios; others at the number";

// Name and text of each number; schema as read_origin gives it. Errors as the reader of that schema.
std::vector<std::pair<std::string, std::string>> summary(const std::string& path, const std::string& schema);

}  // namespace whine
