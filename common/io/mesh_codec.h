// mesh.h5: one tooth sector as finite elements.
#pragma once
#include <string>

#include "io/provenance.h"
#include "solid/sector_mesh.h"

namespace whine {

class Codec;

void describe(Codec& codec, MeshArtifact& a);
void write(const std::string& path, const MeshArtifact& a, const Provenance& provenance);
MeshArtifact read_mesh(const std::string& path);

}  // namespace whine
