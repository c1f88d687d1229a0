// modes.h5: natural frequencies and mode shapes of a system, with the system itself.
#pragma once
#include <string>

#include "io/provenance.h"
#include "system/modes_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, ModesArtifact& a);
void write(const std::string& path, const ModesArtifact& a, const Provenance& provenance);
ModesArtifact read_modes(const std::string& path);

}  // namespace whine
