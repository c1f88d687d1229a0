// system_sweep.h5: periodic motions of a system of elastic gears over its speeds, rising or falling.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/system_sweep_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemSweepArtifact& a);
void write(const std::string& path, const SystemSweepArtifact& a, const Provenance& provenance);
SystemSweepArtifact read_system_sweep(const std::string& path);

}  // namespace whine
