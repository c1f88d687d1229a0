// harris_map.h5: transmission error against torque and tip relief.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/harris_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, HarrisMapArtifact& a);
void write(const std::string& path, const HarrisMapArtifact& a, const Provenance& provenance);
HarrisMapArtifact read_harris_map(const std::string& path);

}  // namespace whine
