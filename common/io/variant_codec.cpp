#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "model/response_quantities.h"

namespace whine {
namespace {

using namespace ranges;

}  // namespace

void describe(Codec& c, VariantResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  c(a.directions, "/parameters/operation/directions", "", "directions of the sweeps; none: at rest");
  if (c.lists() || !a.directions.empty()) {
    describe_motion(c, a);
    c(a.reference_torque, "/parameters/operation/reference_torque", "N m", kDrive, "",
      "torque whose mean stiffness sets the bearing dampers");
    describe_speeds(c, a.frequency_from, a.frequency_to, a.frequency_step);
  }
  c(a.rejection, "/outside_model_reason", "",
    "why the variant lies outside the model's range; empty: it does not");
  if (!a.rejection.empty()) return;
  if (c.lists()) {
    double any = 0;
    c(any, "/quantity/<quantity>", "its own", kQuantity, "",
      "response quantity, those of sweeps for each direction");
    return;
  }
  const std::vector<ResponseQuantity> kinds = response_quantities(a.directions);
  const auto count = static_cast<Eigen::Index>(kinds.size());
  if (c.out() && a.quantity.size() != count)
    fail(Failure::numerical, "result has ", a.quantity.size(), " rows, expected ", count);
  if (!c.out()) a.quantity.resize(count);
  for (Eigen::Index i = 0; i < count; ++i)
    c(a.quantity[i], "/quantity/" + kinds[i].name, kinds[i].units, kQuantity, "", kinds[i].meaning);
}

std::string title(const VariantResult& a) {
  return "Variant of a study: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<VariantResult>;

}  // namespace whine
