// system_branch.h5: a branch of periodic orbits of a system of elastic gears.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/system_branch_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemBranchArtifact& a);
void write(const std::string& path, const SystemBranchArtifact& a, const Provenance& provenance);
SystemBranchArtifact read_system_branch(const std::string& path);

}  // namespace whine
