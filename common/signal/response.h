// What a speed sweep says: the numbers of a frequency response, one row per speed.
//
// DTE = r1 theta1 + r2 theta2 on the line of action. dte_rms is the RMS of its oscillating part (the ordinate
// of the paper's Figs. 4-7), over one orbit, so that subharmonics count; over all stored periods where
// the motion is not periodic. Of each mesh, in its own rotations.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "results/response.h"
#include "results/sweep.h"

namespace whine {

inline constexpr int kResponseHarmonics = 10;

// Rows keep the order in which they were computed. Harmonics are those of the mesh frequency, 10 or as many as the coarsest
// row resolves; of teeth that differ, orders as well, up to the last of these harmonics: harmonics of the hunting frequency,
// which hold the shafts' orders and the sidebands of the mesh frequency. Jumps are the sweep's own: it bisects them. Throws
// Error(input) for a sweep without speeds, arrays whose lengths disagree, values that are not finite, or negative forces.
ResponseResult response(const SweepResult& sweep);

// Ranges of neighbouring speeds (Hz) of which something is true: "2820 to 2980, 3100"; "" if it is of none.
std::string speed_ranges(const std::map<double, bool>& speeds);

// The row after which the sweep crosses f (Hz); -1 if it never does.
Eigen::Index row_before(const Eigen::VectorXd& frequency, double f);

// (jump) The row after which the sweep left the branch that ends at a jump: the step of the sweep in which the jump lies, or
// one before it across which the RMS changes more than on a flank, because a branch's basin gets narrower than a step; the
// sweep then followed the branch to its end by itself. -1 if the jump lies outside the sweep.
std::vector<Eigen::Index> rows_before_jumps(const ResponseResult& r);

// Whether the RMS of the transmission error of two motions differ by more than 20 %: more than that of neighbouring speeds of
// one branch.
bool like_a_jump(double rms, double other);

}  // namespace whine
