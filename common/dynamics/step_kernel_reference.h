// The equations of step_kernel.h in plain matrices, as they read: what the kernel on lanes is compared with. Nothing is packed,
// pipelined, left out as too small or remembered from step to step; contact is solved by methods of its own, for a few pairs
// and some tens of strips.
#pragma once
#include <vector>

#include "dynamics/step_kernel.h"

namespace whine {

class StepReference {
 public:
  // friction: 1, coefficient.
  StepReference(const StepSystem& system, const std::vector<Propagator>& propagators,
                const Relaxation& relaxed, double friction = 0);

  // Takes a state by one step to `position`. Result: transmission error, m. Throws Error(numerical) if contact finds no
  // solution.
  double step(StepState& state, const StepPosition& position) const;
  // Gives teeth the names that they have in the next mesh period: doublets turn by a tooth, loads move on by one.
  void rename(StepState& state) const;

 private:
  Eigen::MatrixXd compliance(
      const StepPosition& position) const;  // (strip, strip) m N-1: A without laws of lines
  Eigen::MatrixXd loading(const StepPosition& position) const;                         // (node, coordinate) L
  Eigen::VectorXd offset(const StepState& state, const StepPosition& position) const;  // (strip) m: e

  const StepSystem& system_;
  Eigen::VectorXd a11_, a12_, a21_, a22_, bq_, bv_;  // (coordinate)
  Relaxation relaxed_step_;
  double friction_;
};

}  // namespace whine
