#include "io/variant_codec.h"

#include "base/error.h"
#include "io/codec.h"
#include "model/response_quantities.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kVariantSchema{"variant", 3};

}  // namespace

void describe(Codec& c, VariantResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  c.choices({"/parameters/operation/directions", "1", "directions of the sweeps; none: at rest", ""},
            a.directions);
  if (c.lists() || !a.directions.empty()) {
    describe_motion(c, a);
    c.dataset({"/parameters/operation/reference_torque", "N m",
               "torque whose mean stiffness sets the bearing dampers", "", kDrive},
              &a.reference_torque);
    describe_speeds(c, a.frequency_from, a.frequency_to, a.frequency_step);
  }
  c.dataset({"/outside_model_reason", "1",
             "why the variant lies outside the model's range; empty: it does not", ""},
            &a.rejection);
  if (!a.rejection.empty()) return;
  if (c.lists()) {
    double any = 0;
    c.dataset({"/quantity/<quantity>", "its own", "response quantity, those of sweeps for each direction", "",
               kQuantity},
              &any);
    return;
  }
  const std::vector<ResponseQuantity> kinds = response_quantities(a.directions);
  const auto count = static_cast<Eigen::Index>(kinds.size());
  if (c.out() && a.quantity.size() != count)
    fail(Failure::numerical, "result has ", a.quantity.size(), " rows, expected ", count);
  if (!c.out()) a.quantity.resize(count);
  for (Eigen::Index i = 0; i < count; ++i)
    c.dataset({"/quantity/" + kinds[i].name, kinds[i].units, kinds[i].meaning, "", kQuantity},
              &a.quantity[i]);
}

void write(const std::string& path, const VariantResult& a, const Provenance& provenance) {
  write_artifact(path, kVariantSchema, "Variant of a study: " + pair_title(a.mesh, a.torque), a, provenance);
}

VariantResult read_variant(const std::string& path) {
  return read_artifact<VariantResult>(path, kVariantSchema);
}

}  // namespace whine
