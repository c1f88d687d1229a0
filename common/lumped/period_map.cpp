#include "lumped/period_map.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = LumpedOscillator::State;

VectorXd LumpedPeriodMap::flat(const State& state) const {
  return state.cwiseQuotient(oscillator_.unit());
}

State LumpedPeriodMap::state(const VectorXd& y) const {
  return y.cwiseProduct(oscillator_.unit());
}

void LumpedPeriodMap::set_parameter(double mesh_frequency) {
  oscillator_.set_speed(mesh_frequency);
  mesh_frequency_ = mesh_frequency;
}

VectorXd LumpedPeriodMap::apply(const VectorXd& y) {
  start_ = state(y);
  State end = start_;
  LumpedOscillator::Matrix derivative = LumpedOscillator::Matrix::Identity();
  oscillator_.integrate(end, &derivative);
  const State unit = oscillator_.unit();
  tangent_ = unit.cwiseInverse().asDiagonal() * derivative * unit.asDiagonal();
  return flat(end);
}

std::vector<ContactEvent> LumpedPeriodMap::events() const {
  std::vector<ContactEvent> events;
  for (const LumpedCrossing& crossing : oscillator_.crossings(start_))
    events.push_back({crossing.border, crossing.rises, crossing.phase});
  return events;
}

VectorXd LumpedPeriodMap::observable() const {
  State state = start_;
  LumpedEnergyBalance energy_balance;
  return oscillator_.record(state, energy_balance).x;
}

}  // namespace whine
