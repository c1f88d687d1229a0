// Folds of the branches of a pair or of a train over a second quantity.
#pragma once
#include <Eigen/Core>
#include <string>

#include "base/choice.h"
#include "base/matrix.h"
#include "results/motion_source.h"

namespace whine {

// What a fold curve goes over, beside the mesh frequency.
enum class FoldQuantity { damping, torque, tip_relief, bearing_stiffness };
template <>
inline constexpr const char* kWordsOf<FoldQuantity> = "damping torque tip_relief bearing_stiffness";

// fold_curves.h5: points in the order of their curves, along each in the order of `value`; two curves that meet in a cusp are
// neighbours.
struct FoldCurvesResult : MotionSource {  // of a pair `torque` is that of the first folds where it varies
  FoldQuantity quantity = FoldQuantity::damping;
  double first_value = 0;  // at which the folds were found along a branch
  Eigen::VectorXi curve;   // (point) 1: counted from 0
  // (point) of the quantity: rayleigh_stiffness in s; N m, of a train on the body whose torque drives it; m of linear tip relief on both
  // gears; stiffness of the elastic bearings over that of the scene
  Eigen::VectorXd value;
  // (point) 1: of two pairs, contact frozen; of slices and trains Rayleigh's, of the mode that gives way most to the driving torque
  Eigen::VectorXd damping_ratio;
  Eigen::VectorXd fold_frequency;  // (point) Hz
  MatrixRM fold_multiplier;        // (point, 2) 1: real multiplier nearest to 1 on either side
  Eigen::VectorXi highest;  // (point) 1: the branch turns back from rising speed; 0: from falling speed
  Eigen::VectorXd cusp_value, cusp_damping_ratio, cusp_frequency;  // (cusp)
  Eigen::VectorXi cusp_curve;  // (cusp) the first of the two curves that meet
  std::string end;             // of each pair of curves, why it was followed no further
};

}  // namespace whine
