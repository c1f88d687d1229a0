// system_branch.h5: a branch of periodic orbits of a system of elastic gears.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/system_branch.h"

namespace whine {

class Codec;

void describe(Codec& codec, SystemBranchResult& a);
void write(const std::string& path, const SystemBranchResult& a, const Provenance& provenance);
SystemBranchResult read_system_branch(const std::string& path);

}  // namespace whine
