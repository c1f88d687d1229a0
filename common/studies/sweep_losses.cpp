#include "studies/sweep_losses.h"

#include "gear/losses.h"

namespace whine {

Eigen::VectorXd loss_factors(const SweepResult& s) {
  if (s.root_stress.empty()) return {};
  const GearPair gears(s);
  Eigen::VectorXd out(s.mesh_frequency.size());
  const auto per_period = static_cast<double>(s.time.steps_per_period);
  for (Eigen::Index f = 0; f < out.size(); ++f) {
    const MatrixRM& load = s.tooth_load[static_cast<size_t>(f)];
    const Eigen::VectorXd phase =
        Eigen::VectorXd::LinSpaced(load.rows(), 0, static_cast<double>(load.rows() - 1)) / per_period;
    out[f] = loss_factor(gears, s.pair, phase, load, s.torque);
  }
  return out;
}

}  // namespace whine
