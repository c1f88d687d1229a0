// The key numbers of an artifact in the units that an engineer reads (um, kN, kHz), for gear-inspect.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "files/scene.h"

namespace whine {

// "as designed", "tip relief 10 um from 20.9 deg".
std::string in_words(const FlankModification& modification);

// Name and text of each number; schema as read_origin gives it. Errors as the reader of that schema.
std::vector<std::pair<std::string, std::string>> summary(const std::string& path, const std::string& schema);

}  // namespace whine
