// body.h5: a gear body reduced to what contact needs of it.
#pragma once
#include <string>

#include "io/provenance.h"
#include "solid/reduced_body.h"

namespace whine {

class Codec;

void describe(Codec& codec, BodyArtifact& a);
void write(const std::string& path, const BodyArtifact& a, const Provenance& provenance);
BodyArtifact read_body(const std::string& path);

}  // namespace whine
