// modes.h5: natural frequencies and mode shapes of a system, with the system itself.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/modes.h"

namespace whine {

class Codec;

void describe(Codec& codec, ModesResult& a);
void write(const std::string& path, const ModesResult& a, const Provenance& provenance);
ModesResult read_modes(const std::string& path);

}  // namespace whine
