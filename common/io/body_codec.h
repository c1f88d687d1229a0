// body.h5: a gear body reduced to what contact needs of it.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/reduced_body.h"

namespace whine {

class Codec;

void describe(Codec& codec, ReducedBody& a);
void write(const std::string& path, const ReducedBody& a, const Provenance& provenance);
ReducedBody read_body(const std::string& path);

}  // namespace whine
