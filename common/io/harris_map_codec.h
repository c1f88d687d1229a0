// harris_map.h5: transmission error against torque and tip relief.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/harris_map.h"

namespace whine {

class Codec;

void describe(Codec& codec, HarrisMapResult& a);
void write(const std::string& path, const HarrisMapResult& a, const Provenance& provenance);
HarrisMapResult read_harris_map(const std::string& path);

}  // namespace whine
