// Figures of responses: against mesh frequency, both directions of a sweep.
#pragma once
#include "report/sweep_panels.h"

namespace whine {

// RMS of the DTE and, if wanted, its mean beside it, against mesh frequency for both directions of the sweep, with jumps. A panel for each set of
// choices (damping, corner rule, fidelity, model) in the order in which they come, a curve for each torque (ascending) and
// each modification of the flanks. With branches the orbits that no sweep finds, unstable ones, and the folds at which
// branches turn. Throws Error(input) unless every sweep up has one sweep down of the same torque and choices.
Figure response_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background = {},
                       bool mean = false);

// Force of each gear on its elastic bearing against mesh frequency for both directions of the sweep: RMS of what of it
// oscillates, and the largest. Throws Error(input) for gears on rigid bearings, for sweeps of two torques or sets of choices,
// else as response_figure.
Figure bearing_force_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background = {});

// K_Hbeta and the largest line load of a pair in slices over the face against speed, both ways. Throws Error(input) for one slice.
Figure face_load_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background = {});

// Ranges of neighbouring speeds at which a mesh loses contact in a sweep, in Hz times a scale: "2820 to 2980, 3100", or "nowhere".
std::string loss_ranges(const ResponseResult& sweep, double scale = 1, Eigen::Index mesh = 0);

// "rising 2820 to 2980, falling 2600 to 2980 Hz", as jumps are said; "" where neither sweep loses contact.
std::string loss_both_ways(const ResponseResult& up, const ResponseResult& down);

// Rows after which a curve breaks: where the sweep left a branch that ends at a jump, and where the RMS changes by half of
// itself at once, over less than 5 % of the speed, and 2.5 times as much as in the steps beside, which is another branch, too. Not so
// where the sweep in the other direction, if it is given, has the motions of both rows: what both find on either side is one branch.
std::vector<bool> broken_after(const ResponseResult& r, const ResponseResult* other = nullptr);

// The response of one direction of a sweep as a curve that lifts the pen where it breaks.
// backlash: with a column that marks the speeds beyond the backlash.
FigureBlock response_block(const std::string& name, const ResponseResult& r, const ResponseResult* other,
                           bool backlash);

}  // namespace whine
