// loaded_<phase>.h5: both gears loaded in one mesh position.
#pragma once
#include <string>

#include "io/provenance.h"
#include "system/loaded_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, LoadedArtifact& a);
void write(const std::string& path, const LoadedArtifact& a, const Provenance& provenance);
LoadedArtifact read_loaded(const std::string& path);

}  // namespace whine
