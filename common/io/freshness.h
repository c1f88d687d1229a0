// Whether an artifact is still what its inputs give.
#pragma once
#include <string>
#include <vector>

#include "io/provenance.h"

namespace whine {

// What has become of an input since, in words; clears fresh if it is not what it was, or not there to tell. Stage parameters
// of a scene is compared with the scene as well: the one given, else the one that it was cut from, if it is known and there.
std::string state_of(const std::string& path, const InputRecord& input, const std::string& scene,
                     bool& fresh);

// All artifacts below a folder, links not followed, in the order of the alphabet; a path to a file is that file.
std::vector<std::string> artifacts_below(const std::string& place);

}  // namespace whine
