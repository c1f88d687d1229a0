// Fold curves of a pair: mesh frequency of the folds against damping, torque or tip relief, with the cusps in which they end.
//
// The folds at one value come from the branch there (studies/branch.h), those at others from these (orbits/fold_curve.h).
// Between the folds of a pair there are two stable motions at one speed, and beyond a cusp one.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/fold_curves.h"
#include "results/reduced_body.h"

namespace whine {

struct FoldCurvesPlan {
  FoldQuantity quantity = FoldQuantity::damping;
  double first = 0;            // value of the branch: damping ratio with two pairs in contact, N m, or m
  std::vector<double> values;  // the same, ascending, to go through on either side of `first`
  double from = 0,
         to = 0;  // Hz, of the branch and of the folds; 0: 0.57 and 1.2 of the rigid gears' natural frequency
};

// statics, settings: as of jump_map(). torque: N m; where it varies `first` counts. A tip relief is linear on both gears, from
// the highest point of single-pair contact, in place of what the scene has. report(done, total, note) is called after each value.
// Throws as jump_map() and pair_branch(), and Error(input) for no value, values that do not
// ascend, or a first damping ratio or torque that is not positive.
FoldCurvesResult fold_curves(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& statics, double torque, const SweepParameters& settings,
                             const FoldCurvesPlan& plan,
                             const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
