// sweep.h5: motions over the speed.
#pragma once
#include <string>

#include "io/provenance.h"
#include "signal/sweep_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, SweepArtifact& a);
void write(const std::string& path, const SweepArtifact& a, const Provenance& provenance);
SweepArtifact read_sweep(const std::string& path);

}  // namespace whine
