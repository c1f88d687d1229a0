// Losses by friction between the flanks.
#pragma once
#include "report/figures.h"
#include "results/response.h"

namespace whine {

// Efficiency (a) and power lost (b) over mesh frequency at each torque, both sweep directions, with the efficiency at rest; the
// moments of friction about both axes over a mesh period at rest, at the first torque (c). A table of each sweep, and one at rest
// with the loss factor H_V apart from the coefficient of friction, and that of rigid teeth. Throws Error(input) for artifacts
// without friction, and unless there is one static.h5 and two sweeps, up and down, at each torque; of 6 torques at most.
// Speeds at which the motion goes beyond the backlash are marked, in the figure and in a column: friction of back flanks, which would
// touch there, is in no number.
Figure efficiency_figure(const std::vector<StaticResult>& statics, const std::vector<ResponseResult>& sweeps);

}  // namespace whine
