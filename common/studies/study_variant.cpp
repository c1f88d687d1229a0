#include "studies/study_variant.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "model/response_quantities.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

using Eigen::Index;

namespace {

using Quantities = std::map<std::string, double>;

void add_static(Quantities& quantities, const StaticResult& rest) {
  const Eigen::VectorXd& te = rest.transmission_error;
  const int periods = rest.hunting_periods, count = resolved_harmonics(te.size(), 3, periods);
  const Harmonics spectrum = harmonics(te, count, periods);
  quantities["contact_ratio"] = rest.contact_ratio;
  quantities["mean_stiffness"] = rest.mean_stiffness;
  quantities["te_mean"] = spectrum.mean;
  quantities["te_peak_to_peak"] = te.maxCoeff() - te.minCoeff();
  const Index positions = te.size() / periods;
  double largest = 0;
  for (int period = 0; period < periods; ++period) {
    const auto own = te.segment(period * positions, positions);
    largest = std::max(largest, own.maxCoeff() - own.minCoeff());
  }
  quantities["te_peak_to_peak_mesh"] = largest;
  for (int h = 1; h <= 3; ++h) {
    if (h > count)
      fail(Failure::input, te.size() / periods, " positions per mesh period do not resolve harmonic ", h,
           " of the transmission error; raise 'positions'");
    quantities[text("te_harmonic_", h)] = spectrum.amplitude[h - 1];
  }
  quantities["tooth_load_static"] = rest.tooth_load.maxCoeff();
}

void add_motion(Quantities& quantities, const ResponseResult& motion) {
  const std::string d = name_of(motion.direction);
  Index worst = 0;
  quantities["natural_frequency"] = motion.natural_frequency;
  quantities["rms_max_" + d] = motion.dte_rms.col(0).maxCoeff(&worst);
  quantities["rms_max_speed_" + d] = motion.mesh_frequency[worst];
  quantities["tooth_load_max_" + d] = motion.tooth_load_max.maxCoeff();
  quantities["separation_max_" + d] = motion.separation_fraction.maxCoeff();
  double from = 0, to = 0;
  for (Index i = 0; i < motion.mesh_frequency.size(); ++i) {
    if (!(motion.separation_fraction(i, 0) > 0)) continue;
    const double f = motion.mesh_frequency[i];
    from = from > 0 ? std::min(from, f) : f;
    to = std::max(to, f);
  }
  quantities["loss_from_" + d] = from;
  quantities["loss_to_" + d] = to;
  quantities["jumps_" + d] = static_cast<double>(motion.jump_frequency.size());
  quantities["jump_frequency_" + d] = motion.jump_frequency.size() > 0 ? motion.jump_frequency.maxCoeff() : 0;
  quantities["unsteady_" + d] = static_cast<double>((motion.period_multiple.array() == 0).count());
}

}  // namespace

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
  const auto add_remarks = [&](const std::string& where, const std::vector<Remark>& remarks) {
    for (const Remark& r : remarks) out.remarks.push_back({r.warning, where + ": " + r.words});
  };
  Quantities quantities;
  const StaticResult rest = static_transmission(driver, driven, settings.statics, settings.torque);
  add_static(quantities, rest);
  add_remarks("at rest", remarks(rest));
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
      add_motion(quantities, response(motion));
      add_remarks(text("speed ", direction), motion.remarks);
    }
  }
  const std::vector<ResponseQuantity> kinds = response_quantities(settings.directions);
  out.quantity.resize(static_cast<Index>(kinds.size()));
  for (size_t i = 0; i < kinds.size(); ++i)
    out.quantity[static_cast<Index>(i)] = quantities.at(kinds[i].name);
  return out;
}

}  // namespace whine
