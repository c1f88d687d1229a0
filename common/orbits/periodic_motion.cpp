#include "orbits/periodic_motion.h"

#include "base/progress.h"
#include "orbits/iteration.h"

namespace whine {
namespace {

using Eigen::VectorXd;

struct MappedMotion : FlatStates {
  PeriodMap& map;
  int most;

  bool turn(VectorXd& y, int number) {
    report_step("period", number, most);
    y = map.apply(y);
    return true;
  }
  bool wanted() const { return true; }
  bool record(VectorXd& y, const Repetition&, bool confirm) {
    if (confirm) y = map.apply(y);
    return true;
  }
};

}  // namespace

VectorXd FlatStates::combination(const std::vector<const VectorXd*>& states, const VectorXd& weight) {
  VectorXd sum = VectorXd::Zero(states[0]->size());
  for (size_t i = 0; i < states.size(); ++i) sum += weight[static_cast<Eigen::Index>(i)] * *states[i];
  return sum;
}

PeriodicMotion iterate_to_orbit(PeriodMap& map, const VectorXd& start, const Iteration& options,
                                AndersonAcceleration<FlatStates>* shared) {
  MappedMotion motion{{}, map, options.most_turns};
  AndersonAcceleration<FlatStates> own;
  VectorXd state = start;
  const Repetition found = *iterate(motion, state, options, shared ? *shared : own);
  return {found, state};
}

}  // namespace whine
