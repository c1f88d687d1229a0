// The quantities of one variant of a study.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/response_quantities.h"

namespace whine {

// variants/ab/ab12....h5 of a study: the response quantities of one variant.
struct VariantResult : MotionParameters, MeshSpeeds {
  // Of a train its layout, damping, model levels and steps, in place of what MotionParameters say of a pair; of a pair no bodies.
  SystemSweepParameters train;
  bool of_train() const { return !train.layout.bodies.empty(); }
  TrainNames names;

  double torque = 0,
         reference_torque = 0;        // N m on the driver of a pair; the second sets the bearing dampers
  std::vector<Direction> directions;  // of its sweeps; none: at rest
  // SI, in the order of response_quantities(directions, names); empty: outside the model's range
  Eigen::VectorXd quantity;
  std::string rejection;  // why the variant lies outside the model's range, "" if it does not
};

}  // namespace whine
