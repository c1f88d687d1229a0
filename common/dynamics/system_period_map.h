// The period map y -> P(y; f) of a system in motion, for periodic motions and orbits: of a mesh period, and where teeth differ of a
// hunting period, which begins with its first mesh period. The latter has no tangent.
//
// y: coordinates and velocities in the energy norm relative to rest, relaxed loads by the energy that each stores by itself (of those
// that hardly move anything 1e-10 of the largest), contact forces relative to the largest of rest: as that of pairs.
// The tangent is one replay of the period with its contacts kept and each Hertz's law by its slope.
#pragma once
#include <utility>

#include "dynamics/motion.h"

namespace whine {

class SystemPeriodMap : public MotionMap {
 public:
  // The positions of `dynamics` are those of the map as long as it lives; steps divide their number.
  SystemPeriodMap(SystemDynamics& dynamics, int steps);
  int size() const override { return static_cast<int>(unit_.size()); }
  void set_parameter(double mesh_frequency) override;
  double parameter() const override { return dynamics_.mesh_frequency(); }
  // Throws ModelRangeError where a tip edge that was left out would touch: take_left_zone() says so.
  Eigen::VectorXd apply(const Eigen::VectorXd& y) override;
  // Error(numerical) if nothing was applied at the present speed, Error(input) where teeth differ.
  Eigen::MatrixXd tangent() override;
  Eigen::MatrixXd tangent_times(const Eigen::MatrixXd& directions) override;
  std::vector<ContactEvent> events() const override;  // contact: the slot
  Eigen::VectorXd observable() const override;        // transmission error of the first mesh
  MotionPeriod shown() const override;
  Eigen::VectorXd flat_of(const MotionState& state) const override {
    return flat(std::get<SystemDynamics::State>(state));
  }
  MotionState state_of(const Eigen::VectorXd& y) const override { return state(y); }
  std::pair<int, int> place_of(int slot) const override;

  // Whether the period applied last left the tip edges that are looked at.
  bool left_last() const { return left_last_; }
  Eigen::VectorXd rest() const { return rest_; }
  Eigen::VectorXd flat(const SystemDynamics::State& state) const;
  SystemDynamics::State state(const Eigen::VectorXd& y) const;
  // The mesh period integrated last.
  const SystemDynamics::Period& period() const { return period_; }

 private:
  void require_tangent() const;  // throws where there is none
  Eigen::MatrixXd moved_on(const SystemDynamics::Position& position, const Eigen::MatrixXd& line_load,
                           const Eigen::MatrixXd& present) const;
  void solve_contacts(int i, const Eigen::MatrixXd& z, const Eigen::MatrixXd& relaxed,
                      const Eigen::MatrixXd& line_load, Eigen::MatrixXd& p) const;
  SystemDynamics& dynamics_;
  bool left_last_ = false, applied_ = false;
  Eigen::VectorXd unit_, rest_;
  SystemDynamics::Period period_;
};

}  // namespace whine
