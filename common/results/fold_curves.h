// Folds of the branches of a pair over a second quantity.
#pragma once
#include <Eigen/Core>
#include <string>

#include "base/choice.h"
#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// What a fold curve goes over, beside the mesh frequency.
enum class FoldQuantity { damping, torque, tip_relief };
template <>
inline constexpr const char* kWordsOf<FoldQuantity> = "damping torque tip_relief";

// fold_curves.h5: points in the order of their curves, along each in the order of `value`; two curves that meet in a cusp are
// neighbours.
struct FoldCurvesResult : MotionParameters {
  double torque = 0;  // N m on the driver; where it varies that of the first folds
  FoldQuantity quantity = FoldQuantity::damping;
  double first_value = 0;  // at which the folds were found along a branch
  Eigen::VectorXi curve;   // (point) 1: counted from 0
  Eigen::VectorXd
      value;  // (point) of the quantity: rayleigh_stiffness in s, N m, m of linear tip relief on both gears
  Eigen::VectorXd damping_ratio;   // (point) 1: of two pairs, contact frozen
  Eigen::VectorXd fold_frequency;  // (point) Hz
  MatrixRM fold_multiplier;        // (point, 2) 1: real multiplier nearest to 1 on either side
  Eigen::VectorXi highest;  // (point) 1: the branch turns back from rising speed; 0: from falling speed
  Eigen::VectorXd cusp_value, cusp_damping_ratio, cusp_frequency;  // (cusp)
  Eigen::VectorXi cusp_curve;  // (cusp) the first of the two curves that meet
  std::string end;             // of each pair of curves, why it was followed no further
};

}  // namespace whine
