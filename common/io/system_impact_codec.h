// system_impact.h5: natural frequencies and damping of a system of elastic gears by ring-down.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/system_impact_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemImpactArtifact& a);
void write(const std::string& path, const SystemImpactArtifact& a, const Provenance& provenance);
SystemImpactArtifact read_system_impact(const std::string& path);

}  // namespace whine
