// The stable periodic motion that the iterates of a period map converge to, for sweeps.
//
// y <- P(y) until the state repeats to `periodicity`. Close to a periodic motion Anderson's method (Fang and Saad, Numer. Linear
// Algebra Appl. 16 (2009) 197, type II) takes out as many slow multipliers as it has differences. It is used only where the
// multipliers that the differences show lie inside the unit circle (below 0.9, unless the periods followed each other), and a
// proposal counts only if the map comes closer from there. After a proposal a state that repeats is periodic only if the next period
// brings it closer still: an unstable motion that was hit is left again.
#pragma once
#include <Eigen/Core>

#include "orbits/period_map.h"

namespace whine {

struct PeriodicMotionOptions {
  double periodicity = 1e-5;  // distance of states at which they repeat
  int most_periods = 3000;
  bool accelerate = true;
};

struct PeriodicMotion {
  Eigen::VectorXd state;  // at the end of the last period
  int multiple = 1;       // periods after which it repeats; 0: it does not
  int periods = 0;        // that were integrated
  double residual = 0;    // distance over `multiple` periods
};

// At the map's parameter. Throws what the map throws, but for proposals.
PeriodicMotion iterate_to_orbit(PeriodMap& map, const Eigen::VectorXd& start,
                                const PeriodicMotionOptions& options);

}  // namespace whine
