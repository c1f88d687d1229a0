// What gear-sweep tells beside its files.
#pragma once
#include <string>
#include <vector>

#include "results/sweep.h"
#include "results/sweep_errors.h"
#include "studies/next_level.h"

namespace whine {

// What the next model level changes: a line of the motions, one of jumps and branches.
std::vector<std::string> change_words(const NextSweep& next, const SweepResult& here,
                                      const SweepResult& there);
// The largest errors of a sweep, and where.
std::string sweep_errors_words(const SweepErrorsResult& errors);

}  // namespace whine
