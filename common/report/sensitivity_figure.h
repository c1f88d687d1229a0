// What a scene's open choices are worth: the sensitivity to each input.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/jump_map.h"

namespace whine {

// What each variant changes against the base, in the last case of the maps: mean
// stiffness, natural frequencies, ends of the branches, tooth load (sustained). Every case stands in the table. Throws Error(input)
// for no variant, one that differs in torque or cases, or one in which no key differs.
Figure sensitivity_figure(const JumpMapResult& base, const std::vector<JumpMapResult>& variants);

}  // namespace whine
