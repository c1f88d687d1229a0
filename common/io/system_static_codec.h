// system_static.h5: a system of elastic gears at rest over a mesh period.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/system_static.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemStaticResult& a);
void write(const std::string& path, const SystemStaticResult& a, const Provenance& provenance);
SystemStaticResult read_system_static(const std::string& path);

}  // namespace whine
