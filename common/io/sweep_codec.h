// sweep.h5: motions over the speed.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/sweep.h"

namespace whine {

class Codec;

void describe(Codec& codec, SweepResult& a);
void write(const std::string& path, const SweepResult& a, const Provenance& provenance);
SweepResult read_sweep(const std::string& path);

}  // namespace whine
