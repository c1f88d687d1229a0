// One variant of a study from bodies to answers: static equilibrium, sweeps, and the numbers that a study gathers.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "motion/statics.h"
#include "motion/variant_result.h"
#include "solid/reduced_body.h"

namespace whine {

// Fills what of the artifact is a parameter: gears, mesh, operation, damping, discretisation.
VariantArtifact variant_parameters(const BodyArtifact& driver, const BodyArtifact& driven,
                                   const VariantSlice& slice);

struct VariantAnswers {
  Eigen::VectorXd answer;       // SI, in the order of answer_kinds(slice.directions)
  std::vector<Remark> remarks;  // of the statics and of each sweep, which they name
};

// The answers are those of static_transmission at the variant's torque and of the response of sweep() in each direction; equal
// to what the stages one by one answer, and so are the remarks. report(done, total, note) is called after each speed. Throws as
// static_transmission, sweep and response.
VariantAnswers variant_answers(const BodyArtifact& driver, const BodyArtifact& driven,
                               const VariantSlice& slice,
                               const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
