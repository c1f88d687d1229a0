#include "orbits/periodic_motion.h"

#include "base/progress.h"
#include "orbits/iteration.h"

namespace whine {
namespace {

using Eigen::VectorXd;

// A period map's states, which are rows of numbers in the units of their distance.
struct MappedMotion {
  using State = VectorXd;
  static constexpr int kColumns = 4;  // differences, as many multipliers go at once
  PeriodMap& map;
  int most;

  VectorXd difference(const VectorXd& a, const VectorXd& b) const { return a - b; }
  double distance(const VectorXd& a, const VectorXd& b) const { return (a - b).norm(); }
  VectorXd combination(const std::vector<const VectorXd*>& states, const VectorXd& weight) const {
    VectorXd sum = VectorXd::Zero(states[0]->size());
    for (size_t i = 0; i < states.size(); ++i) sum += weight[static_cast<Eigen::Index>(i)] * *states[i];
    return sum;
  }
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

PeriodicMotion iterate_to_orbit(PeriodMap& map, const VectorXd& start, const Iteration& options) {
  MappedMotion motion{map, options.most_turns};
  AndersonAcceleration<MappedMotion> acceleration;
  VectorXd state = start;
  const Repetition found = *iterate(motion, state, options, acceleration);
  return {found, state};
}

}  // namespace whine
