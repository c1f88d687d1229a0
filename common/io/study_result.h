// study.h5: the response quantities of its variants.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "io/study.h"

namespace whine {

struct StudyResult {
  StudyPlan plan;
  std::vector<GatheredVariant> variants;
  MatrixRM
      quantity;  // (variant, response quantity of the plan) SI; 0 where the variant lies outside the model's range
  std::vector<std::string> rejection;  // (variant) why, "" if it was not
  Eigen::VectorXi unsteady;  // (variant) speeds, of all its sweeps, at which no periodic motion was found
};

}  // namespace whine
