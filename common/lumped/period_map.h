// The period map of a lumped oscillator: state (x / reference length, v / (that times the natural frequency)).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "lumped/oscillator.h"
#include "orbits/period_map.h"

namespace whine {

class LumpedPeriodMap : public PeriodMap {
 public:
  // Nobody else may change the oscillator's speed as long as the map lives.
  explicit LumpedPeriodMap(LumpedOscillator& oscillator) : oscillator_(oscillator) {}

  int size() const override { return 2; }
  void set_parameter(double mesh_frequency) override;  // Hz
  double parameter() const override { return mesh_frequency_; }
  Eigen::VectorXd apply(const Eigen::VectorXd& y) override;
  Eigen::MatrixXd tangent() override { return tangent_; }
  // Contact i: the i-th border of the springs' gaps, from the lowest, at which a spring begins to touch.
  std::vector<ContactEvent> events() const override;
  Eigen::VectorXd observable() const override;  // (sample) m: x

  Eigen::VectorXd flat(const LumpedOscillator::State& state) const;
  LumpedOscillator::State state(const Eigen::VectorXd& y) const;

 private:
  LumpedOscillator& oscillator_;
  double mesh_frequency_ = 0;
  LumpedOscillator::State start_ = LumpedOscillator::State::Zero();  // of the period applied last
  LumpedOscillator::Matrix tangent_ = LumpedOscillator::Matrix::Identity();
};

}  // namespace whine
