// The stable periodic motion that the iterates of a period map converge to, for sweeps.
#pragma once
#include <Eigen/Core>

#include "orbits/iteration.h"
#include "orbits/period_map.h"

namespace whine {

struct PeriodicMotion : Repetition {
  Eigen::VectorXd state;  // at the end of the last period
};

// At the map's parameter. Throws what the map throws, but for proposals.
PeriodicMotion iterate_to_orbit(PeriodMap& map, const Eigen::VectorXd& start, const Iteration& options);

}  // namespace whine
