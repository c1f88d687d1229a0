#include "studies/jump_map.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "dynamics/impact.h"
#include "gear/pair.h"
#include "model/capabilities.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

using Eigen::VectorXd;

double rayleigh_stiffness_for(double ratio, const FixedPhaseMesh& mesh, BodyModel body, double frequency) {
  const double without = frozen_root(with_rayleigh_stiffness(mesh, 0, body)).damping_ratio;
  if (!(ratio > without))
    fail(Failure::input, "bearings and mass-proportional damping alone give a damping ratio of ", without,
         ", above ", ratio, "; ask for more, or lower bearing_ratio or rayleigh_mass_per_s");
  double eta = (ratio - without) / (std::numbers::pi * frequency);
  for (int i = 0; i < 60; ++i) {
    const double found = frozen_root(with_rayleigh_stiffness(mesh, eta, body)).damping_ratio;
    if (std::abs(found - ratio) < 1e-9 * ratio) return eta;
    if (!(found > without)) break;
    eta *= (ratio - without) / (found - without);
  }
  fail(Failure::input, "no rayleigh_stiffness_s gives a damping ratio of ", ratio,
       " with two pairs in contact; ask for less, or lower undamped_depth_mm");
}

JumpMapResult jump_map(const ReducedBody& driver, const ReducedBody& driven, const StaticParameters& statics,
                       double torque, const SweepParameters& settings, const JumpMapPlan& plan,
                       const std::function<void(long, long, const std::string&)>& report) {
  const size_t cases = plan.rayleigh_stiffness.size() + plan.damping_ratio.size();
  if (cases == 0)
    fail(Failure::input, "no case: give damping ratios or Rayleigh stiffness factors, one at least");
  for (const auto& [what, values] : {std::pair{"a Rayleigh stiffness factor", &plan.rayleigh_stiffness},
                                     std::pair{"a damping ratio", &plan.damping_ratio}})
    for (double value : *values)
      if (!(value > 0 && value < 1))
        fail(Failure::input, what, " of ", value, "; it must be above 0 and below 1");

  require_able("jump-map", traits(statics.mesh, driver.design, driven.design));
  const StaticResult rest = static_transmission(driver, driven, statics, torque);
  const double bearing_stiffness =
      torque == settings.reference_torque
          ? rest.mean_stiffness
          : static_transmission(driver, driven, statics, settings.reference_torque).mean_stiffness;
  const GearPair kinematics(driver.design, driven.design, statics.mesh.centre_distance);
  double inverse_mass = 0;  // kg-1
  for (int g = 0; g < kSides; ++g)
    inverse_mass += std::pow(kinematics.gear(g).base_radius(), 2) / settings.inertia[g];
  const VectorXd speed =
      map_speeds(plan, std::sqrt(rest.mean_stiffness * inverse_mass) / (2 * std::numbers::pi));

  SweepParameters fixed = settings;
  fixed.fidelity.contact = ContactModel::strips;  // the body under a fixed contact is read on strips
  fixed.damping.rayleigh_stiffness = 0;
  JumpMapResult result;
  const FixedPhaseState* two = nullptr;
  const std::vector<FixedPhaseState> states =
      fixed_phase_states(driver, driven, rest, bearing_stiffness, fixed, kStatePhases);
  for (const FixedPhaseState& state : states) {
    if (state.contact_state == ContactState::one) result.one_pair_frequency = state.undamped_frequency;
    if (state.contact_state == ContactState::two) two = &state;
  }
  if (!two)
    fail(Failure::input, "at ", torque,
         " N m no mesh phase has two pairs in contact, to which the damping ratio belongs");
  result.two_pair_frequency = two->undamped_frequency;
  set_motion(result, {driver, driven}, rest, settings);
  result.damping = fixed.damping;
  result.torque = torque;
  result.bearing_stiffness = bearing_stiffness;
  result.mean_stiffness = rest.mean_stiffness;
  result.first_harmonic = harmonics(rest.stiffness_secant, 1).amplitude[0];

  const auto n = static_cast<Eigen::Index>(cases);
  start_cases(result, n, speed, plan.load_frequency);

  SweepParameters own = settings;
  own.frequency_from = speed[0];
  own.frequency_to = speed[speed.size() - 1];
  own.frequency_step = plan.step;
  for (Eigen::Index c = 0; c < n; ++c) {
    const auto given = static_cast<Eigen::Index>(plan.rayleigh_stiffness.size());
    own.damping.rayleigh_stiffness =
        c < given ? plan.rayleigh_stiffness[c]
                  : rayleigh_stiffness_for(plan.damping_ratio[c - given], two->mesh, settings.fidelity.body,
                                           two->undamped_frequency);
    result.rayleigh_stiffness[c] = own.damping.rayleigh_stiffness;
    const double ratio = frozen_root(with_rayleigh_stiffness(two->mesh, own.damping.rayleigh_stiffness,
                                                             settings.fidelity.body))
                             .damping_ratio;
    result.damping_ratio[c] = ratio;
    result.excitation[c] = result.first_harmonic / result.mean_stiffness / (2 * ratio);
    add_case(result, c, plan.step, [&](Direction direction, std::vector<BranchPoint>& beyond) {
      SweepResult swept = sweep(
          driver, driven, rest, bearing_stiffness, own, direction, [](long, long, const std::string&) {},
          &beyond);
      report(2 * c + (direction == Direction::up ? 1 : 2), 2 * n, text("damping ratio ", ratio));
      return swept;
    });
  }
  return result;
}

}  // namespace whine
