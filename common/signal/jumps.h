// Where a branch of periodic motions ends as the speed goes on.
//
// The RMS is continuous along a branch. A jump is a discontinuity that persists as the frequency step tends to zero. A small jump and a
// steep flank look alike at coarse speeds; smaller steps distinguish them.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "signal/branches.h"

namespace whine {

// The motion that a speed led to.
struct BranchMotion {
  double mesh_frequency = 0;  // Hz
  double rms = 0;             // m, of the oscillating transmission error
  int multiple = 0;           // mesh periods of the orbit; 0: not periodic
};

// True if the RMS of a sweep may step, or the orbit repeats otherwise, between the motions i - 1 and i: the motions before
// lead to another RMS half-way than those after, by more than 4 %, in a straight line and, where there are two on each side,
// in a curve. Finer speeds say what it is.
bool may_break(const std::vector<BranchMotion>& sweep, size_t i);

struct BranchWalk {
  double step = 0;    // Hz, below 0 for falling speed: between the speeds of the sweep, the largest taken
  double limit = 0;   // Hz, furthest speed
  int fineness = 64;  // a power of two: steps are halved down to this part
  // At a speed (Hz), from the motion kept last. A run may give up, as a motion that is not periodic, once the RMS of its
  // mesh periods differs by more than the factor `most` from that of the motion kept last.
  std::function<BranchMotion(double mesh_frequency, double most)> run;
  std::function<void(int n)> keep;  // the motion of run n, counted from 0, to go on from it
};
struct BranchEnd {
  double last = 0, next = 0;  // Hz: furthest speed on the branch, and that which the branch does not reach
  bool outlived = false;      // the branch goes on beyond the limit, which `last` is
};

// Follows the branch of motion i - 1 of a sweep, the motion kept first, with steps that are halved where they leave it, to
// where it ends. Nothing if it leads to motion i, where the sweep has one; or beyond, since a sweep leaves a branch whose
// basin has become narrower than its step. Steps shrink in time where three motions point to a fold, at which speed is
// quadratic in the level of the motion.
std::optional<BranchEnd> branch_end(const BranchWalk& walk, const std::vector<BranchMotion>& sweep, size_t i);

// How a model goes on from the motion i - 1 of a sweep: as BranchWalk, `keep` with what a map of jumps takes of the motion.
struct BranchContinuation {
  std::function<BranchMotion(double mesh_frequency, double most)> run;
  std::function<BranchPoint(int n)> keep;
  double finest = 0;  // Hz: steps are halved down to that; 0: to 1/64 of the sweep's
};
struct BranchJump {
  double frequency = 0, width = 0;  // Hz: middle and width of the interval in which the branch ends
  bool located = false;             // by following the branch; otherwise between the two speeds of the sweep
  double last = 0;                  // Hz: furthest speed on the branch, if located
};
// The jump between the motions i - 1 and i of a sweep, or beyond where the sweep left the branch early, by branch_end();
// nothing if the branch leads from one to the other. follower: called for a motion i - 1 that is periodic. left_early: takes
// the motions kept on the way, if given.
std::optional<BranchJump> find_jump(const std::vector<BranchMotion>& sweep, size_t i,
                                    const std::function<BranchContinuation()>& follower,
                                    std::vector<BranchPoint>* left_early);

}  // namespace whine
