// branch.h5: periodic orbits along their branch.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/branch.h"

namespace whine {

class Codec;

void describe(Codec& codec, BranchResult& a);
void write(const std::string& path, const BranchResult& a, const Provenance& provenance);
BranchResult read_branch(const std::string& path);

}  // namespace whine
