// How large the discretisation errors of the motions over speed are, and what they come from.
#pragma once
#include <vector>

#include "report/figures.h"
#include "results/sweep_errors.h"

namespace whine {

// One sweep, or both directions of one operating point. Throws Error(input) for two of one direction.
Figure sweep_errors_figure(const std::vector<SweepErrorsResult>& sweeps);

}  // namespace whine
