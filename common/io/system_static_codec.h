// system_static.h5: a system of elastic gears at rest over a mesh period.
#pragma once
#include <string>

#include "io/provenance.h"
#include "system/system_static_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemStaticArtifact& a);
void write(const std::string& path, const SystemStaticArtifact& a, const Provenance& provenance);
SystemStaticArtifact read_system_static(const std::string& path);

}  // namespace whine
