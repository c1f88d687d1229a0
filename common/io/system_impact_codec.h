// system_impact.h5: natural frequencies and damping of a system of elastic gears by ring-down.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/system_impact.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemImpactResult& a);
void write(const std::string& path, const SystemImpactResult& a, const Provenance& provenance);
SystemImpactResult read_system_impact(const std::string& path);

}  // namespace whine
