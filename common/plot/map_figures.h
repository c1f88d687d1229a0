// Figures of what a scene's open choices are worth: maps of jumps, and the sensitivity to each input.
#pragma once
#include <vector>

#include "motion/harris_result.h"
#include "plot/figures.h"
#include "signal/jump_map_result.h"

namespace whine {

// One panel per corner rule or lumped model: torque against damping ratio, with the cells that have two branches or lose
// contact, and lines of the largest tooth load (held for 1/64 of a mesh period). For the pair of P2000 its printed
// statements stand beside. Throws Error(input) for no map, for two of the same torque and panel, and unless all have
// the same damping ratios and gears and each panel the same torques.
Figure jump_map_figure(std::vector<JumpMapArtifact> maps);

// The same of lumped models, a column each, with the damper always on above and in contact only below; beside them the elastic
// pair, of whose maps those with the corner rule of the lumped models' statics are taken. In words: which models jump at every
// torque at P2000's lumped damping, which lose contact at low torque only, in how many cells they answer as the elastic pair,
// what decides. Throws Error(input) without a lumped model, else as jump_map_figure.
Figure lumped_jump_map_figure(std::vector<JumpMapArtifact> maps);

// Peak-to-peak transmission error against torque and tip relief, with the best relief of each torque and the optimum for the
// design torque; beside it, against torque, that relief of each start and no relief (the Harris cusp). The map is that of
// the start whose optimum is least. With a dynamic part its map of the RMS at the worst speed stands below.
Figure harris_map_figure(const HarrisMapArtifact& map);

// What each variant changes against the base, in the last case of the maps: mean
// stiffness, natural frequencies, ends of the branches, tooth load (held). Every case stands in the table. Throws Error(input)
// for no variant, one that differs in torque or cases, or one in which no key differs.
Figure sensitivity_figure(const JumpMapArtifact& base, const std::vector<JumpMapArtifact>& variants);

}  // namespace whine
