#include "signal/jump_cause.h"

#include <cmath>

namespace whine {

const char* name(JumpCause cause) {
  switch (cause) {
    case JumpCause::fold:
      return "fold";
    case JumpCause::flip:
      return "flip";
    case JumpCause::basin:
      return "basin left";
  }
  return "";
}

CausedJump cause_of_jump(const BranchResult& branch, double frequency, double width) {
  constexpr double kZones = 2e-4;
  double nearest = 0.5 * width + kZones * frequency;
  CausedJump found;
  const auto look = [&](const Eigen::VectorXd& frequencies, JumpCause cause) {
    for (const double f : frequencies) {
      if (!(std::abs(f - frequency) <= nearest)) continue;
      nearest = std::abs(f - frequency);
      found = {cause, f};
    }
  };
  look(branch.fold_frequency, JumpCause::fold);
  look(branch.flip_frequency, JumpCause::flip);
  return found;
}

}  // namespace whine
