// mesh.h5: one tooth sector as finite elements.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/sector_grid.h"

namespace whine {

class Codec;

void describe(Codec& codec, SectorGrid& a);
void write(const std::string& path, const SectorGrid& a, const Provenance& provenance);
SectorGrid read_mesh(const std::string& path);

}  // namespace whine
