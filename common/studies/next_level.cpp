#include "studies/next_level.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "signal/response.h"
#include "studies/refinement.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

namespace {

StaticResult statics_with(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& like,
                          ContactModel contact) {
  StaticParameters settings;
  settings.mesh = like.mesh;
  settings.fidelity = like.fidelity;
  settings.fidelity.contact = contact;
  settings.contact = like.contact;
  return static_transmission(driver, driven, settings, like.torque);
}

ReducedBody with_all_modes(const ReducedBody& body) {
  return reduced_again(body, body.discretisation, kAllModes);
}

void add(LevelChange& change, double relative, double frequency) {
  change.rms += relative * relative;
  if (std::abs(relative) <= change.largest) return;
  change.largest = std::abs(relative);
  change.at = frequency;
}

}  // namespace

std::vector<NextSweep> next_sweeps(const ReducedBody& driver, const ReducedBody& driven,
                                   const StaticResult& statics, const StaticResult& reference,
                                   const SweepParameters& settings) {
  std::vector<NextSweep> sweeps;
  std::string reasons;
  const Fidelity& from = settings.fidelity;
  const auto blank = [&](const char* key, const std::string& level) {
    return NextSweep{key, level, "", {driver, driven}, statics, reference.mean_stiffness, settings, ""};
  };
  const auto give_reason = [&](const NextSweep& next, const std::string& reason) {
    reasons += text(reasons.empty() ? "" : "; ", next.key, " = \"", next.from, "\" ", reason);
  };
  NextSweep by_contact = blank("contact", name_of(from.contact));
  if (const auto to = next_of(from.contact)) {
    by_contact.to = name_of(*to);
    by_contact.settings.fidelity.contact = *to;
    by_contact.statics = statics_with(driver, driven, statics, *to);
    by_contact.mean_stiffness = reference.torque == statics.torque
                                    ? by_contact.statics.mean_stiffness
                                    : statics_with(driver, driven, reference, *to).mean_stiffness;
    sweeps.push_back(std::move(by_contact));
  } else {
    give_reason(by_contact, "is the last model level of contact");
  }
  NextSweep by_body = blank("body", name_of(from.body));
  if (const auto to = next_of(from.body)) {
    by_body.to = name_of(*to);
    by_body.settings.fidelity.body = *to;
    if (*to == BodyModel::full) {
      try {
        by_body.body[0] = with_all_modes(driver);
        by_body.body[1] = driver.compliance == driven.compliance ? by_body.body[0] : with_all_modes(driven);
      } catch (const Error& error) {
        if (error.kind() != Failure::input) throw;
        by_body.missing = error.what();
        give_reason(by_body, "is followed by \"full\": " + by_body.missing);
      }
    }
    sweeps.push_back(std::move(by_body));
  } else {
    give_reason(by_body, "is the last model level of body");
  }
  if (std::all_of(sweeps.begin(), sweeps.end(), [](const NextSweep& s) { return !s.missing.empty(); }))
    fail(Failure::input, reasons);
  return sweeps;
}

std::vector<SpeedCompared> compared_speeds(const ResponseResult& a, const ResponseResult& b) {
  const Eigen::Index speeds = a.mesh_frequency.size();
  if (b.mesh_frequency.size() != speeds || a.mesh_frequency != b.mesh_frequency)
    fail(Failure::input, "two sweeps of ", speeds, " and ", b.mesh_frequency.size(),
         " speeds are not of the same speeds in the same order; they cannot be compared");
  std::vector<bool> jumped(static_cast<size_t>(speeds), false);  // a branch was left before this speed
  for (const ResponseResult* r : {&a, &b})
    for (const Eigen::Index i : rows_before_jumps(*r))
      if (i >= 0) jumped[static_cast<size_t>(i) + 1] = true;
  std::vector<SpeedCompared> out(static_cast<size_t>(speeds), SpeedCompared::yes);
  bool apart = false;
  for (Eigen::Index i = 0; i < speeds; ++i) {
    apart = (apart || jumped[static_cast<size_t>(i)]) &&
            like_a_jump(a.dte_rms.row(i).norm(), b.dte_rms.row(i).norm());
    if (a.period_multiple[i] < 1 || a.period_multiple[i] != b.period_multiple[i])
      out[static_cast<size_t>(i)] = SpeedCompared::uneven;
    else if (apart)
      out[static_cast<size_t>(i)] = SpeedCompared::apart;
  }
  return out;
}

SweepChange sweep_change(const SweepResult& here, const SweepResult& next) {
  const ResponseResult a = response(here), b = response(next);
  const std::vector<SpeedCompared> speeds = compared_speeds(a, b);
  SweepChange change;
  change.apart = static_cast<int>(std::count(speeds.begin(), speeds.end(), SpeedCompared::apart));
  change.uneven = static_cast<int>(std::count(speeds.begin(), speeds.end(), SpeedCompared::uneven));
  change.compared = static_cast<int>(std::count(speeds.begin(), speeds.end(), SpeedCompared::yes));
  for (Eigen::Index i = 0; i < a.mesh_frequency.size(); ++i) {
    if (speeds[static_cast<size_t>(i)] != SpeedCompared::yes) continue;
    add(change.dte_rms, a.dte_rms(i, 0) / b.dte_rms(i, 0) - 1, a.mesh_frequency[i]);
    add(change.dte_mean, a.dte_mean(i, 0) / b.dte_mean(i, 0) - 1, a.mesh_frequency[i]);
    add(change.tooth_load, a.tooth_load_max(i, 0) / b.tooth_load_max(i, 0) - 1, a.mesh_frequency[i]);
  }
  for (LevelChange* c : {&change.dte_rms, &change.dte_mean, &change.tooth_load})
    c->rms = change.compared > 0 ? std::sqrt(c->rms / change.compared) : 0;
  return change;
}

}  // namespace whine
