// The periodic motion that a period map's iterates settle into, for sweeps.
//
// y <- P(y) until the state repeats to `periodicity`. Close to a periodic motion Anderson's method (Fang and Saad, Numer. Linear
// Algebra Appl. 16 (2009) 197, type II) takes out as many slow multipliers as it has differences. It is used only where the
// multipliers that the differences show lie inside the unit circle, and a proposal counts only if the map comes closer from there.
#pragma once
#include <Eigen/Core>

#include "orbits/period_map.h"

namespace whine {

struct SettleOptions {
  double periodicity = 1e-5;  // distance of states at which they repeat
  int most_periods = 3000;
  bool accelerate = true;
};

struct SettledMotion {
  Eigen::VectorXd start;  // of the last period
  int multiple = 1;       // periods after which it repeats; 0: it does not
  int periods = 0;        // that were integrated
  double residual = 0;    // distance over `multiple` periods
};

// At the map's parameter. Throws what the map throws, but for proposals.
SettledMotion settle(PeriodMap& map, const Eigen::VectorXd& start, const SettleOptions& options);

}  // namespace whine
