// What one variant of a study answers.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// variants/ab/ab12....h5 of a study: what one variant answers. As the artifacts of schemas.h.
struct VariantArtifact : MotionParameters {
  double torque = 0, reference_torque = 0;  // N m on the driver; the second sets the bearing dampers
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;  // Hz
  std::vector<std::string> directions;                              // of its sweeps; none: at rest
  Eigen::VectorXd answer;  // SI, in the order of answer_kinds(directions); empty: refused
  std::string refusal;     // why a stage refused the variant, "" if none did
};

}  // namespace whine
