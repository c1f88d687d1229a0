// jump_map.h5: the range of two branches against damping.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/jump_map.h"

namespace whine {

class Codec;

void describe(Codec& codec, JumpMapResult& a);
void write(const std::string& path, const JumpMapResult& a, const Provenance& provenance);
JumpMapResult read_jump_map(const std::string& path);

}  // namespace whine
