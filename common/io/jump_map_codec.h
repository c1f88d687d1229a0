// jump_map.h5: the range of two branches against damping.
#pragma once
#include <string>

#include "io/provenance.h"
#include "signal/jump_map_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, JumpMapArtifact& a);
void write(const std::string& path, const JumpMapArtifact& a, const Provenance& provenance);
JumpMapArtifact read_jump_map(const std::string& path);

}  // namespace whine
