#include "studies/study_variant.h"

#include <utility>

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

VariantResponse in_order(const Quantities& quantities, const std::vector<ResponseQuantity>& kinds,
                         VariantResponse out) {
  out.quantity.resize(static_cast<Index>(kinds.size()));
  for (size_t i = 0; i < kinds.size(); ++i)
    out.quantity[static_cast<Index>(i)] = quantities.at(kinds[i].name);
  return out;
}

void add_remarks(const std::string& where, const std::vector<Remark>& remarks, VariantResponse& out) {
  for (const Remark& r : remarks) out.remarks.push_back({r.warning, where + ": " + r.words});
}

}  // namespace

VariantResult variant_parameters(const VariantParameters& settings) {
  VariantResult out;
  out.train = settings.train;
  out.names = train_names(settings.train);
  out.directions = settings.directions;
  out.frequency_from = settings.train.frequency_from;
  out.frequency_to = settings.train.frequency_to;
  out.frequency_step = settings.train.frequency_step;
  return out;
}

VariantResponse variant_response(const std::vector<ReducedBody>& bodies, const VariantParameters& settings,
                                 const std::function<void(long, long, const std::string&)>& report) {
  const SystemSweepParameters& train = settings.train;
  const TrainNames names = train_names(train);
  VariantResponse out;
  const SystemStaticResult rest = system_at_rest(train, bodies);
  Quantities quantities = quantities_of(rest);
  add_remarks("at rest", rest.remarks, out);
  for (const Direction direction : settings.directions) {
    const SweepResult motion = system_sweep(train, bodies, direction, report);
    quantities.merge(quantities_of(response(motion), &train));
    add_remarks(text("speed ", direction), motion.remarks, out);
  }
  return in_order(quantities, response_quantities(settings.directions, names), std::move(out));
}

VariantResult variant_parameters(const ReducedBody& driver, const ReducedBody& driven,
                                 const VariantParameters& settings) {
  VariantResult out;
  set_pair(out, {driver, driven}, settings.statics);
  set_motion(out, {driver, driven}, out, settings.motion);
  if (settings.directions.empty()) out.fidelity = settings.statics.fidelity;
  out.torque = settings.torque;
  out.directions = settings.directions;
  out.time = settings.motion.time;
  out.reference_torque = settings.motion.reference_torque;
  out.frequency_from = settings.motion.frequency_from;
  out.frequency_to = settings.motion.frequency_to;
  out.frequency_step = settings.motion.frequency_step;
  return out;
}

VariantResponse variant_response(const ReducedBody& driver, const ReducedBody& driven,
                                 const VariantParameters& settings,
                                 const std::function<void(long, long, const std::string&)>& report) {
  VariantResponse out;
  const StaticResult rest = static_transmission(driver, driven, settings.statics, settings.torque);
  Quantities quantities = quantities_of(rest);
  add_remarks("at rest", remarks(rest), out);
  if (!settings.directions.empty()) {
    // Without bearing dampers nothing depends on the pair at the reference torque.
    const bool alike =
        settings.torque == settings.motion.reference_torque || settings.motion.damping.bearing_ratio == 0;
    const double bearing_stiffness =
        alike ? rest.mean_stiffness
              : static_transmission(driver, driven, settings.statics, settings.motion.reference_torque)
                    .mean_stiffness;
    for (Direction direction : settings.directions) {
      const SweepResult motion =
          sweep(driver, driven, rest, bearing_stiffness, settings.motion, direction, report);
      quantities.merge(quantities_of(response(motion)));
      add_remarks(text("speed ", direction), motion.remarks, out);
    }
  }
  return in_order(quantities, response_quantities(settings.directions), std::move(out));
}

}  // namespace whine
