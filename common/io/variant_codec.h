// variants/ab/ab12....h5: what one variant of a study answers.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/variant_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, VariantArtifact& a);
void write(const std::string& path, const VariantArtifact& a, const Provenance& provenance);
VariantArtifact read_variant(const std::string& path);

}  // namespace whine
