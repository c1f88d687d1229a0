// Fold curves: mesh frequency of the folds against damping ratio, torque or tip relief, with their cusps.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/fold_curves.h"
#include "results/jump_map.h"

namespace whine {

// A colour for each artifact, all of one quantity; marks for jumps of the sweeps of maps, of elastic pairs over damping at the same
// torque and corner rule. Notes count the sweeps' jumps within 1 Hz of a curve, and the cells of the maps that lie on the
// right side of the cusps. Throws Error(input) for no artifact, more than six or different quantities.
Figure fold_curve_figure(const std::vector<FoldCurvesResult>& curves, const std::vector<JumpMapResult>& maps);

}  // namespace whine
