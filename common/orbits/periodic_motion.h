// The stable periodic motion that the iterates of a period map converge to, for sweeps.
#pragma once
#include <Eigen/Core>

#include "orbits/iteration.h"
#include "orbits/period_map.h"

namespace whine {

// A period map's states, which are rows of numbers in the units of their distance, for iterate() and predicted().
struct FlatStates {
  using State = Eigen::VectorXd;
  static constexpr int kColumns = 4;  // differences, as many multipliers go at once
  Eigen::VectorXd difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const { return a - b; }
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const { return (a - b).norm(); }
  static Eigen::VectorXd combination(const std::vector<const Eigen::VectorXd*>& states,
                                     const Eigen::VectorXd& weight);
};

struct PeriodicMotion : Repetition {
  Eigen::VectorXd state;  // at the end of the last period
};

// At the map's parameter. shared: columns of a speed nearby to begin with, then of this one. Throws what the map throws, but for
// proposals.
PeriodicMotion iterate_to_orbit(PeriodMap& map, const Eigen::VectorXd& start, const Iteration& options,
                                AndersonAcceleration<FlatStates>* shared = nullptr);

}  // namespace whine
