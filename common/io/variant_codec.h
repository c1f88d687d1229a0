// variants/ab/ab12....h5: what one variant of a study answers.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/variant.h"

namespace whine {

class Codec;

void describe(Codec& codec, VariantResult& a);
void write(const std::string& path, const VariantResult& a, const Provenance& provenance);
VariantResult read_variant(const std::string& path);

}  // namespace whine
