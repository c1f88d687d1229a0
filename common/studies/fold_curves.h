// Fold curves of a pair or a train: mesh frequency of the folds against damping, torque, tip relief or bearing stiffness, with the cusps in
// which they end.
//
// The folds at one value come from the branch there (studies/branch.h), those at others from these (orbits/fold_curve.h).
// Between the folds of a scene there are two stable motions at one speed, and beyond a cusp one.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "model/system_stages.h"
#include "results/fold_curves.h"
#include "results/reduced_body.h"

namespace whine {

struct FoldCurvesPlan {
  FoldQuantity quantity = FoldQuantity::damping;
  // Value of the branch: damping ratio; N m, of a train on the body whose torque drives it, all others in proportion; m; 1, stiffness of
  // all elastic bearings over that of the scene. The damping ratio is that of a pair with two pairs in contact, of slices and trains
  // Rayleigh's of the mode that gives way most to the driving torque.
  double first = 0;
  std::vector<double> values;  // the same, ascending, to go through on either side of `first`
  // Hz, of the branch and of the folds; 0: 0.57 and 1.2 of the rigid gears' natural frequency, of slices and trains the scene's speeds
  double from = 0, to = 0;
};

using FoldReport = std::function<void(long, long, const std::string&)>;

// statics, settings: as of jump_map(). torque: N m; where it varies `first` counts. A tip relief is linear on both gears, from
// the highest point of single-pair contact, in place of what the scene has. report(done, total, note) is called after each value.
// Throws as jump_map() and pair_branch(), and Error(input) for no value, values that do not ascend, a first value that is not
// positive, a bearing stiffness without an elastic bearing, a tip relief of slices.
FoldCurvesResult fold_curves(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& statics, double torque, const SweepParameters& settings,
                             const FoldCurvesPlan& plan, const FoldReport& report);

// The same of a train. bodies: [gear] of settings.body. Throws as system_branch(), and Error(input) likewise and for a tip relief.
FoldCurvesResult fold_curves(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                             const FoldCurvesPlan& plan, const FoldReport& report);

}  // namespace whine
