// static.h5: a pair at rest over its mesh phase.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/static.h"

namespace whine {

class Codec;

void describe(Codec& codec, StaticResult& a);
void write(const std::string& path, const StaticResult& a, const Provenance& provenance);
StaticResult read_static(const std::string& path);

}  // namespace whine
