// The largest that a mesh period sustains for 1/64 of it: mesh force, tooth load and root stress of both gears.
//
// At up to 128 samples of the period: of what a sweep holds (signal/branches.h), which has all stored samples, within the change
// of a load over 1/128 of a mesh period.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "dynamics/motion_period.h"
#include "studies/motion_root_stress.h"

namespace whine {

class SustainedPeaks {
 public:
  // Of a mesh of the system, which is kept by reference. steps: per period, the least of those that will be asked for; those are multiples
  // of it by powers of two.
  SustainedPeaks(const SystemModel& system, Eigen::Index mesh, int steps);
  bool root_stress() const { return roots_.known(); }
  // (2, or kRows with root stress) N, N, Pa, Pa: mesh force, load of one pair, root stress of driver and driven gear; then where
  // either root stress occurs, as in a sweep: rad, angles of the roots' tangents; 1, mesh phases of the teeth's pairs. In mesh
  // period `number`, from 0, of a motion that repeats after `periods`, or never: kNever. Periods are given in their order: what is held
  // across the start of one counts with it, and across the end of the last with that. The load of one pair is not followed there.
  static constexpr int kNever = 0, kRows = 2 + 3 * kSides;
  Eigen::VectorXd of(const MotionPeriod& period, int number = 0, int periods = 1);
  // The largest of this period and those before it, from number 0 on.
  Eigen::VectorXd so_far(const MotionPeriod& period, int number, int periods);

 private:
  Eigen::Index mesh_;
  int samples_;
  MotionRootStress roots_;
  MatrixRM load_;   // (sample, pair) N
  MatrixRM along_;  // (sample, quantity) of all pairs together, and the places of the root stresses
  MatrixRM first_, last_,
      joined_;  // (sample, quantity) start of period 0, end of the period before, all that is looked at
  Eigen::VectorXd so_far_;
};

// [mesh]
std::vector<SustainedPeaks> sustained_peaks(const SystemModel& system, int steps);

}  // namespace whine
