// branch.h5: periodic orbits along their branch.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/branch_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, BranchArtifact& a);
void write(const std::string& path, const BranchArtifact& a, const Provenance& provenance);
BranchArtifact read_branch(const std::string& path);

}  // namespace whine
