// Maps of jumps: torque against damping ratio, of the elastic pair and of lumped models.
#pragma once
#include <vector>

#include "report/figures.h"
#include "report/printed_jumps.h"
#include "results/fold_curves.h"
#include "results/jump_map.h"

namespace whine {

// One panel per corner rule or lumped model: torque against damping ratio, with the cells that have two branches or lose
// contact, and lines of the largest tooth load (sustained for 1/64 of a mesh period). What is printed of
// their gears stands beside. Throws Error(input) for no map, for two of the same torque and panel, and unless all have
// the same damping ratios and gears and each panel the same torques.
// curves: over damping, whose last cusps are drawn over the cells of the panel with their corner rule: to the left of them
// there are two branches.
Figure jump_map_figure(std::vector<JumpMapResult> maps, const std::vector<FoldCurvesResult>& curves = {},
                       PrintedJumps printed = {});

// The same of lumped models, a column each, with the damper always on above and in contact only below; beside them the elastic
// pair, of whose maps those with the corner rule of the lumped models' statics are taken. In words: which models jump at every
// torque at the printed damping, or that amid the map, which lose contact at the printed low torque only, in how many cells they
// answer as the elastic pair, what decides. Throws Error(input) without a lumped model, else as jump_map_figure.
Figure lumped_jump_map_figure(std::vector<JumpMapResult> maps, PrintedJumps printed = {});

}  // namespace whine
