#include "motion/study_variant.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "model/answers.h"
#include "motion/statics.h"
#include "motion/sweep.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;

namespace {

using Answers = std::map<std::string, double>;

void add_static(Answers& answers, const StaticArtifact& rest) {
  const Eigen::VectorXd& te = rest.transmission_error;
  const int periods = rest.hunting_periods, count = resolved_harmonics(te.size(), 3, periods);
  const Harmonics spectrum = harmonics(te, count, periods);
  answers["contact_ratio"] = rest.contact_ratio;
  answers["mean_stiffness"] = rest.mean_stiffness;
  answers["te_mean"] = spectrum.mean;
  answers["te_peak_to_peak"] = te.maxCoeff() - te.minCoeff();
  const Index positions = te.size() / periods;
  double largest = 0;
  for (int period = 0; period < periods; ++period) {
    const auto own = te.segment(period * positions, positions);
    largest = std::max(largest, own.maxCoeff() - own.minCoeff());
  }
  answers["te_peak_to_peak_mesh"] = largest;
  for (int h = 1; h <= 3; ++h) {
    if (h > count)
      fail(Failure::input, te.size() / periods, " positions per mesh period do not resolve harmonic ", h,
           " of the transmission error; raise 'positions'");
    answers[text("te_harmonic_", h)] = spectrum.amplitude[h - 1];
  }
  answers["tooth_load_static"] = rest.tooth_load.maxCoeff();
}

void add_motion(Answers& answers, const ResponseArtifact& motion) {
  const std::string& d = motion.direction;
  Index worst = 0;
  answers["natural_frequency"] = motion.natural_frequency;
  answers["rms_max_" + d] = motion.dte_rms.maxCoeff(&worst);
  answers["rms_max_speed_" + d] = motion.mesh_frequency[worst];
  answers["tooth_load_max_" + d] = motion.tooth_load_max.maxCoeff();
  answers["separation_max_" + d] = motion.separation_fraction.maxCoeff();
  double from = 0, to = 0;
  for (Index i = 0; i < motion.mesh_frequency.size(); ++i) {
    if (!(motion.separation_fraction[i] > 0)) continue;
    const double f = motion.mesh_frequency[i];
    from = from > 0 ? std::min(from, f) : f;
    to = std::max(to, f);
  }
  answers["loss_from_" + d] = from;
  answers["loss_to_" + d] = to;
  answers["jumps_" + d] = static_cast<double>(motion.jump_frequency.size());
  answers["jump_frequency_" + d] = motion.jump_frequency.size() > 0 ? motion.jump_frequency.maxCoeff() : 0;
  answers["unsteady_" + d] = static_cast<double>((motion.period_multiple.array() == 0).count());
}

}  // namespace

VariantArtifact variant_parameters(const BodyArtifact& driver, const BodyArtifact& driven,
                                   const VariantSlice& slice) {
  VariantArtifact out;
  set_gears(out, driver, driven);
  out.mesh = slice.statics.mesh;
  out.fidelity = slice.directions.empty() ? slice.statics.fidelity : slice.motion.fidelity;
  out.contact = slice.statics.contact;
  out.torque = slice.torque;
  out.directions = slice.directions;
  out.time = slice.motion.time;
  out.damping = slice.motion.damping;
  out.reference_torque = slice.motion.reference_torque;
  out.driver_inertia = slice.motion.driver_inertia;
  out.driven_inertia = slice.motion.driven_inertia;
  out.frequency_from = slice.motion.frequency_from;
  out.frequency_to = slice.motion.frequency_to;
  out.frequency_step = slice.motion.frequency_step;
  return out;
}

VariantAnswers variant_answers(const BodyArtifact& driver, const BodyArtifact& driven,
                               const VariantSlice& slice,
                               const std::function<void(long, long, const std::string&)>& report) {
  VariantAnswers out;
  const auto add_remarks = [&](const std::string& where, const std::vector<Remark>& remarks) {
    for (const Remark& r : remarks) out.remarks.push_back({r.warning, where + ": " + r.words});
  };
  Answers answers;
  const StaticArtifact rest = static_transmission(driver, driven, slice.statics, slice.torque);
  add_static(answers, rest);
  add_remarks("at rest", remarks(rest));
  if (!slice.directions.empty()) {
    // Without bearing dampers nothing depends on the pair at the reference torque.
    const bool alike =
        slice.torque == slice.motion.reference_torque || slice.motion.damping.bearing_ratio == 0;
    const double bearing_stiffness =
        alike ? rest.mean_stiffness
              : static_transmission(driver, driven, slice.statics, slice.motion.reference_torque)
                    .mean_stiffness;
    for (const std::string& direction : slice.directions) {
      const SweepArtifact motion =
          sweep(driver, driven, rest, bearing_stiffness, slice.motion, direction, report);
      add_motion(answers, response(motion));
      add_remarks("speed " + direction, remarks(motion, rest));
    }
  }
  const std::vector<AnswerKind> kinds = answer_kinds(slice.directions);
  out.answer.resize(static_cast<Index>(kinds.size()));
  for (size_t i = 0; i < kinds.size(); ++i) out.answer[static_cast<Index>(i)] = answers.at(kinds[i].name);
  return out;
}

}  // namespace whine
