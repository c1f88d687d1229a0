// The period map y -> P(y; f) of a system in motion, for periodic motions and orbits.
//
// y: coordinates and velocities in the energy norm relative to rest, relaxed loads and contact forces relative to those of rest.
// The tangent is one replay of the period with its contacts kept and each Hertz's law by its slope.
#pragma once
#include <optional>

#include "dynamics/system_dynamics.h"
#include "orbits/period_map.h"

namespace whine {

class SystemPeriodMap : public PeriodMap {
 public:
  // The positions of `dynamics` are those of the map as long as it lives; steps divide their number.
  SystemPeriodMap(SystemDynamics& dynamics, int steps);
  int size() const override { return static_cast<int>(unit_.size()); }
  void set_parameter(double mesh_frequency) override;
  double parameter() const override { return dynamics_.mesh_frequency(); }
  // Throws ModelRangeError where a tip edge that was left out would touch: left_zone() says so.
  Eigen::VectorXd apply(const Eigen::VectorXd& y) override;
  Eigen::MatrixXd tangent() override;
  Eigen::MatrixXd tangent_times(const Eigen::MatrixXd& directions) override;
  std::vector<ContactEvent> events() const override;  // contact: the slot
  Eigen::VectorXd observable() const override;        // transmission error of the first mesh

  bool left_zone() const { return left_zone_; }
  Eigen::VectorXd rest() const { return rest_; }
  Eigen::VectorXd flat(const SystemDynamics::State& state) const;
  SystemDynamics::State state(const Eigen::VectorXd& y) const;
  const SystemDynamics::Period& period() const { return period_; }

 private:
  SystemDynamics& dynamics_;
  int steps_;
  bool left_zone_ = false;
  Eigen::VectorXd unit_, rest_;
  SystemDynamics::Period period_;
};

}  // namespace whine
