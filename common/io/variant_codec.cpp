#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/keys.h"
#include "io/system_motion_codec.h"
#include "model/response_quantities.h"

namespace whine {
namespace {

using namespace ranges;

}  // namespace

namespace {

// Bodies and meshes of a train, and what its quantities are of.
void describe_train(Codec& c, VariantResult& a) {
  if (!c.optional("/layout/body/name", a.of_train())) return;
  describe_layout(c, a.train.layout, {"/layout", ""});
  describe_names(c, a.names.meshes, a.names.bodies);
  if (c.optional("/shared_mesh", !a.names.shared.empty()))
    c(a.names.shared, "/shared_mesh", "shared_mesh", "[[mesh]] of several planets, which share its load");
  if (c.lists() || !c.optional("/parameters/damping/rayleigh_stiffness", !a.directions.empty())) return;
  c.parameters("damping", keys(a.train.damping));
  c.parameters("discretisation", keys(a.train.time));
}

}  // namespace

void describe(Codec& c, VariantResult& a) {
  describe_train(c, a);
  c(a.directions, "/parameters/operation/directions", "", "directions of the sweeps; none: at rest");
  const bool moves = c.lists() || !a.directions.empty();
  if (!a.of_train()) {
    describe_pair(c, a);
    describe_torque(c, a.torque);
    if (moves) {
      describe_motion(c, a);
      c(a.reference_torque, "/parameters/operation/reference_torque", "N m", kDrive, "",
        "torque whose mean stiffness sets the bearing dampers");
    }
  }
  if (moves) describe_speeds(c, a);
  c(a.rejection, "/outside_model_reason", "",
    "why the variant lies outside the model's range; empty: it does not");
  if (!a.rejection.empty()) return;
  if (c.lists()) {
    double any = 0;
    c(any, "/quantity/<quantity>", "its own", kQuantity, "",
      "response quantity, those of sweeps for each direction, of trains for each mesh and body");
    return;
  }
  const std::vector<ResponseQuantity> kinds = response_quantities(a.directions, a.names);
  const auto count = static_cast<Eigen::Index>(kinds.size());
  if (c.out() && a.quantity.size() != count)
    fail(Failure::numerical, "result has ", a.quantity.size(), " rows, expected ", count);
  if (!c.out()) a.quantity.resize(count);
  for (Eigen::Index i = 0; i < count; ++i)
    c(a.quantity[i], "/quantity/" + kinds[i].name, kinds[i].units, kQuantity, "", kinds[i].meaning);
}

std::string title(const VariantResult& a) {
  return "Variant of a study: " + (a.of_train() ? text("a train of ", a.names.bodies.size(), " bodies, ",
                                                       a.names.meshes.size(), " meshes")
                                                : pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<VariantResult>;

}  // namespace whine
