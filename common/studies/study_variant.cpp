#include "studies/study_variant.h"

#include <array>

#include "base/error.h"
#include "model/response_quantities.h"
#include "signal/response.h"
#include "signal/result_quantities.h"
#include "studies/sweep.h"
#include "system/statics.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::Index;

namespace {

void add_remarks(const std::string& where, const std::vector<Remark>& remarks, VariantResponse& out) {
  for (const Remark& r : remarks) out.remarks.push_back({r.warning, where + ": " + r.words});
}

}  // namespace

VariantResult variant_parameters(const std::vector<ReducedBody>& bodies, const VariantParameters& settings) {
  VariantResult out;
  out.directions = settings.directions;
  static_cast<MeshSpeeds&>(out) =
      settings.of_train() ? MeshSpeeds(settings.train) : MeshSpeeds(settings.motion);
  if (settings.of_train()) {
    out.train = settings.train;
    out.names = train_names(settings.train);
    return out;
  }
  const std::array<BodyParameters, kSides> gears{bodies.at(0), bodies.at(1)};
  set_pair(out, gears, settings.statics);
  set_motion(out, gears, out, settings.motion);
  if (settings.directions.empty()) out.fidelity = settings.statics.fidelity;
  out.torque = settings.torque;
  out.reference_torque = settings.motion.reference_torque;
  return out;
}

VariantResponse variant_response(const std::vector<ReducedBody>& bodies, const VariantParameters& settings,
                                 const std::function<void(long, long, const std::string&)>& report) {
  VariantResponse out;
  Quantities quantities;
  const SystemSweepParameters* const train = settings.of_train() ? &settings.train : nullptr;
  const auto take_rest = [&](const auto& rest, const std::vector<Remark>& said) {
    quantities = quantities_of(rest);
    add_remarks("at rest", said, out);
  };
  const auto take_motions = [&](const std::function<SweepResult(Direction)>& swept) {
    for (const Direction direction : settings.directions) {
      const SweepResult motion = swept(direction);
      quantities.merge(quantities_of(response(motion), train));
      add_remarks(text("speed ", direction), motion.remarks, out);
    }
  };
  if (train) {
    const SystemStaticResult rest = system_at_rest(*train, bodies);
    take_rest(rest, rest.remarks);
    take_motions([&](Direction direction) { return system_sweep(*train, bodies, direction, report); });
  } else {
    const auto at = [&](double torque) {
      return static_transmission(bodies.at(0), bodies.at(1), settings.statics, torque);
    };
    const StaticResult rest = at(settings.torque);
    take_rest(rest, remarks(rest));
    // Without bearing dampers nothing depends on the pair at the reference torque.
    const SweepParameters& motion = settings.motion;
    const bool alike = settings.directions.empty() || settings.torque == motion.reference_torque ||
                       motion.damping.bearing_ratio == 0;
    const double stiffness = alike ? rest.mean_stiffness : at(motion.reference_torque).mean_stiffness;
    take_motions([&](Direction direction) {
      return sweep(bodies[0], bodies[1], rest, stiffness, motion, direction, report);
    });
  }
  const std::vector<ResponseQuantity> kinds =
      response_quantities(settings.directions, train ? train_names(*train) : TrainNames());
  out.quantity.resize(static_cast<Index>(kinds.size()));
  for (size_t i = 0; i < kinds.size(); ++i)
    out.quantity[static_cast<Index>(i)] = quantities.at(kinds[i].name);
  return out;
}

}  // namespace whine
