// impact.h5: ring-down at fixed mesh phases.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/impact.h"

namespace whine {

class Codec;

void describe(Codec& codec, ImpactResult& a);
void write(const std::string& path, const ImpactResult& a, const Provenance& provenance);
ImpactResult read_impact(const std::string& path);

}  // namespace whine
