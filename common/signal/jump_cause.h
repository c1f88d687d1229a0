// Why a sweep jumps, by the branch of periodic orbits at its torque.
#pragma once
#include "results/branch.h"

namespace whine {

// fold: the branch that the sweep was on turns back there; flip: its period doubles; basin: neither is near, so that the branch
// goes on and the sweep has left its basin of attraction, or it is another branch.
enum class JumpCause { fold, flip, basin };
const char* name(JumpCause cause);

struct CausedJump {
  JumpCause cause = JumpCause::basin;
  double frequency = 0;  // Hz: of the fold or the flip; 0 without
};

// frequency, width: Hz, middle and width of the interval in which the sweep jumps. A fold or a flip counts within that interval,
// widened by 2e-4 of the speed for the wider contact zone that a sweep may have come with.
CausedJump cause_of_jump(const BranchResult& branch, double frequency, double width);

}  // namespace whine
