// static.h5: a pair at rest over its mesh phase.
#pragma once
#include <string>

#include "io/provenance.h"
#include "signal/static_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, StaticArtifact& a);
void write(const std::string& path, const StaticArtifact& a, const Provenance& provenance);
StaticArtifact read_static(const std::string& path);

}  // namespace whine
