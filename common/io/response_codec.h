// response.h5: what a sweep says, per speed.
#pragma once
#include <string>

#include "io/provenance.h"
#include "signal/response_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, ResponseArtifact& a);
void write(const std::string& path, const ResponseArtifact& a, const Provenance& provenance);
ResponseArtifact read_response(const std::string& path);

}  // namespace whine
