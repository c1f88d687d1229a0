// One variant of a study from bodies to response quantities: static equilibrium, sweeps, and the numbers that a study gathers.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/variant.h"
#include "system/statics.h"

namespace whine {

// Fills what of the artifact is a parameter: gears, mesh, operation, damping, discretisation; of a train its layout and what its
// quantities are of. bodies: driver and driven gear, of a train [gear] of settings.train.body.
VariantResult variant_parameters(const std::vector<ReducedBody>& bodies, const VariantParameters& settings);

struct VariantResponse {
  Eigen::VectorXd quantity;     // SI, in the order of response_quantities()
  std::vector<Remark> remarks;  // of the statics and of each sweep, which they name
};

// The response quantities are those of static_transmission at the variant's torque and of the response of sweep() in each
// direction, of a train of system_at_rest and system_sweep; equal to what the stages one by one answer, and so are the remarks.
// report(done, total, note) is called after each speed. Throws as these.
VariantResponse variant_response(const std::vector<ReducedBody>& bodies, const VariantParameters& settings,
                                 const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
