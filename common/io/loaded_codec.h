// loaded_<phase>.h5: both gears loaded in one mesh position.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/loaded.h"

namespace whine {

class Codec;

void describe(Codec& codec, LoadedResult& a);
void write(const std::string& path, const LoadedResult& a, const Provenance& provenance);
LoadedResult read_loaded(const std::string& path);

}  // namespace whine
