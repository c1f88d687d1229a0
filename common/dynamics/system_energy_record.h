// Adds to the energy balance of a period of SystemDynamics while it is integrated.
#pragma once
#include <vector>

#include "dynamics/step_work.h"
#include "dynamics/system_dynamics.h"

namespace whine {

class SystemEnergyRecord {
 public:
  // balance: null records nothing.
  SystemEnergyRecord(const SystemDynamics& dynamics, EnergyBalance* balance);
  void start(const SystemDynamics::Position& position);
  void step(const SystemDynamics::Position& position);
  void finish();  // after the teeth have been renamed

 private:
  // State at one end of a step.
  struct Instant {
    const SystemDynamics::Position* position = nullptr;
    Eigen::VectorXd z, v, force, relaxed, load;
    Eigen::VectorXd start;                   // v as the next step propagates it, turned by Coriolis forces
    Eigen::VectorXd field, moved;            // C relaxed and C load in the slots of `rows`
    std::vector<SystemDynamics::Live> rows;  // [mesh]
    std::vector<SystemDynamics::Live> live;  // [mesh] outside which relaxed and load are 0
    Eigen::VectorXd p, d, local;             // (contact) N, m, m
    double stored = 0;                       // J: at once
    Eigen::VectorXd line_load, present, opening;  // (slot) N m-1, (slot) N m-1, (contact) m: in slices
    Eigen::VectorXd normal, slide;  // (body) N m, with friction: moments of normal forces, of friction
    Eigen::VectorXd momentum;  // (body) N m s: of rigid rotations, with what the dampers of the axes took
    Eigen::VectorXd sliding;   // (mesh) W: mu s N v of the kinematics
  };
  void fill(Instant& now, const SystemDynamics::Position& position) const;
  void displace(Instant& at, const std::vector<SystemDynamics::Live>& wanted) const;
  double modes(const Instant& a, const Instant& b);
  double relaxation(const Instant& a, const Instant& b);
  double record(double stored, double damping, double averaging);  // of relaxed loads; result: their sum
  double uneven(const Instant& a, const Instant& b);
  double contact(const Instant& a, const Instant& b);
  void fill_friction(Instant& now) const;
  void find_pivots();
  double turning_speed(int gear) const;
  double friction(const Instant& a, const Instant& b);
  double field_at(const SystemDynamics::Position& position, int k, const Eigen::VectorXd& field) const;

  const SystemDynamics& of_;
  EnergyBalance* balance_;
  Instant before_, now_;
  double sum_ = 0;
  Eigen::VectorXd exchange_, carried_;  // (slot), (mesh) J: of the step, see uneven()
  bool first_step_ = true;
  std::vector<Eigen::Index>
      pivot_;                // gears that what holds the mean speed follows from, one for each rolling
  Eigen::MatrixXd holding_;  // (body, pivot) 1: D of each body by those of these gears
  step_work::DampingIntegrals damping_;
};

}  // namespace whine
