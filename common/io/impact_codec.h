// impact.h5: ring-down at fixed mesh phases.
#pragma once
#include <string>

#include "dynamics/impact_result.h"
#include "io/provenance.h"

namespace whine {

class Codec;

void describe(Codec& codec, ImpactArtifact& a);
void write(const std::string& path, const ImpactArtifact& a, const Provenance& provenance);
ImpactArtifact read_impact(const std::string& path);

}  // namespace whine
