// The largest that a mesh period holds for 1/64 of it: mesh force, tooth load and root stress of both gears.
//
// At up to 128 samples of the period: of what a sweep holds (signal/branches.h), which has all stored samples, within the change
// of a load over 1/128 of a mesh period. Root stress is quasi-static in the tooth loads (system/root_stress.h).
#pragma once
#include <Eigen/Core>

#include "dynamics/dynamics.h"
#include "system/root_stress.h"

namespace whine {

class HeldPeaks {
 public:
  // model is kept by reference. steps: per period, the least of those that will be asked for; those are multiples of it by powers
  // of two.
  HeldPeaks(const GearMeshModel& model, int steps);
  bool root_stress() const { return roots_.known(); }
  // (2, or 4 with root stress) N, N, Pa, Pa: mesh force, load of one pair, root stress of driver and driven gear. The period is
  // taken to repeat, as that of an orbit of one period does.
  Eigen::VectorXd of(const RollingDynamics::Period& period);

 private:
  RootStresses roots_;
  int samples_;
  Eigen::VectorXi pair_;
  MatrixRM load_;   // (sample, pair) N
  MatrixRM along_;  // (sample, quantity) of all pairs together
};

}  // namespace whine
