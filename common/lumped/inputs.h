// What a lumped model is made from: statics at its torque and at the reference torque, and the springs of the mesh.
#pragma once
#include "lumped/sweep.h"

namespace whine {

struct LumpedInputs {
  StaticResult at_torque, at_reference;  // equal where the levels are not those of another torque
};

// Spring models of the mesh.
struct SpringChoice {
  MotionModel model = MotionModel::rectangular;  // pairs_hertz: polygons of Hertz's law
  bool stated = false;  // rectangular: with these levels (N m-1) and this share of the second
  double fewer = 0, more = 0, duty = 0;
  int cells = 0;  // in a mesh period; 0: a multiple of the static positions, 1024 or more
};

// numbers: the tooth pair of each spring, filled.
LumpedParameters springs_of(const LumpedInputs& inputs, const SpringChoice& choice, Eigen::VectorXi& numbers);

}  // namespace whine
