#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "gear/pair.h"
#include "gear/scene_geometry.h"
#include "studies/sweep.h"

namespace whine {

using Eigen::VectorXd;

double stiffness_damping_ratio(const StaticResult& statics, const Damping& damping,
                               const std::array<double, kSides>& inertia) {
  double inverse_mass = 0;
  for (int g = 0; g < kSides; ++g) {
    const double r = ToothGeometry(statics.gear[g].design).base_radius();
    inverse_mass += r * r / inertia[g];
  }
  return 0.5 * damping.rayleigh_stiffness * std::sqrt(statics.mean_stiffness * inverse_mass);
}

double steps_per_oscillation(const SweepResult& sweep) {
  double rate = std::numeric_limits<double>::infinity();  // Hz, of time steps
  for (const double f : sweep.mesh_frequency) rate = std::min(rate, f * steps_at(sweep.time, f));
  return rate / sweep.natural_frequency;
}

VectorXd least_closing(const SweepResult& s) {
  VectorXd least(s.mesh_frequency.size());
  if (!s.mesh.on_bearings()) {
    for (Eigen::Index i = 0; i < least.size(); ++i)
      least[i] = s.transmission_error[static_cast<size_t>(i)].minCoeff();
    return least;
  }
  const GearPair gears(s);
  for (Eigen::Index i = 0; i < least.size(); ++i) {
    VectorXd closing = s.transmission_error[static_cast<size_t>(i)].col(0);
    for (size_t g = 0; g < s.bearing_force.size(); ++g)
      if (!s.bearing_force[g].empty())
        closing += (g == 0 ? 1 : -1) / s.mesh.bearing[g].stiffness *
                   (s.bearing_force[g][static_cast<size_t>(i)] * contact_normal(gears));
    least[i] = closing.minCoeff();
  }
  return least;
}

Eigen::VectorXd backlash_left(const SweepResult& s) {
  // By the samples that are stored: between them a motion swings back further by the square of their distance.
  const VectorXd least = least_closing(s);
  return least.array() - least.minCoeff() + s.backlash_margin;
}

namespace {

// The eta that a scene without [damping] gets is that of P2000's pair; others it damps by what nobody chose.
std::optional<Remark> damping_remark(const StaticResult& statics, const std::array<double, kSides>& inertia,
                                     const Damping& damping) {
  const auto of_paper = [](const BodyParameters& gear) {
    return gear.design.teeth == 50 && std::abs(gear.design.module - 3e-3) < 1e-9;
  };
  const double ratio = stiffness_damping_ratio(statics, damping, inertia);
  const bool fits =
      ratio >= 0.01 && ratio <= 0.12 && std::all_of(statics.gear.begin(), statics.gear.end(), of_paper);
  if (damping.rayleigh_stiffness != kDefaultRayleighStiffness || fits) return {};
  // Ring-downs of pairs, which tell it better, are of one slice; the estimate goes with eta.
  constexpr double kWanted = 0.07;
  std::ostringstream percent, wanted;
  percent << std::setprecision(3) << ratio * 100;
  wanted << std::setprecision(2) << damping.rayleigh_stiffness * kWanted / ratio;
  return remark(
      true, "rayleigh_stiffness_s = ", damping.rayleigh_stiffness,
      ", the default, is for the gears of P2000; these it gives a damping ratio of about ", percent.str(),
      " % (eta w / 2 on the mean mesh stiffness). ",
      statics.fidelity.width == WidthModel::one
          ? std::string(
                "`make SCENE=path/to/scene.toml calibrate DAMPING=0.07` prints the value for 7 %, to be put into [damping]")
          : text("For about 7 % write rayleigh_stiffness_s = ", wanted.str(), " into [damping]"));
}

}  // namespace

std::vector<Remark> setup_remarks(const StaticResult& statics, const std::array<double, kSides>& inertia,
                                  const Damping& damping, const Fidelity& fidelity) {
  std::vector<Remark> out;
  if (fidelity.body != BodyModel::rigid && fidelity.body != BodyModel::quasi_static)
    if (const auto damped = damping_remark(statics, inertia, damping)) out.push_back(*damped);
  for (int g = 0; g < kSides; ++g) {
    const std::string words =
        flywheel(statics.gear[g].design, statics.gear[g].material, inertia[g], statics.mesh.gear[g]);
    if (!words.empty()) out.push_back(remark(true, words));
  }
  return out;
}

std::vector<Remark> remarks(const SweepResult& s, const StaticResult& statics) {
  constexpr double kFewestSteps = 8;  // an oscillation in so few steps is 5 % off its frequency
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  // Said once of a pair of sweeps, by the one of rising speed.
  if (s.direction == Direction::up && elastic(s)) {
    out = setup_remarks(statics, s.inertia, s.damping, s.fidelity);
    if (s.mesh_frequency.size() > 0) {
      const std::vector<Remark> more =
          schlenk_speed_remarks(s, s.mesh_frequency.minCoeff(), s.mesh_frequency.maxCoeff());
      out.insert(out.end(), more.begin(), more.end());
    }
  }
  if (const double steps = steps_per_oscillation(s); steps < kFewestSteps)
    add(true, "a time step is too long for the contact: ", steps,
        " steps per oscillation at its natural frequency of ", s.natural_frequency, " Hz, ", kFewestSteps,
        " are needed to follow it; raise min_sample_rate_kHz or steps_per_period");
  constexpr double kImbalance = 1e-6;  // of the energy that goes in: what rounding leaves is below 1e-9
  if (Eigen::Index worst = 0;
      s.energy_imbalance.size() > 0 && s.energy_imbalance.cwiseAbs().maxCoeff(&worst) > kImbalance)
    add(true, "the energy balance does not close: at ", s.mesh_frequency[worst], " Hz it is off by ",
        shown_number(std::abs(s.energy_imbalance[worst])), " of the energy that goes in, at most ",
        kImbalance, " is right; do not rely on this sweep, and check [damping]");
  for (Eigen::Index i = 0; i < s.mesh_frequency.size(); ++i)
    if (s.period_multiple[i] == 0)
      add(true, "at ", s.mesh_frequency[i], " Hz the motion is not periodic after ", s.periods[i],
          " mesh periods; the state still changes by ", s.residual[i], " per period");
    else if (s.period_multiple[i] > s.hunting_periods)
      add(false, "at ", s.mesh_frequency[i], " Hz the motion is subharmonic: it repeats after ",
          s.period_multiple[i], " mesh periods");
  // Against the least transmission error at which unloaded teeth touch.
  const double least = least_closing(s).minCoeff() - statics.unloaded_error.minCoeff();
  if (least < 0 && !std::isfinite(s.backlash_margin))
    add(false, "the teeth swing ", std::round(-least * 1e7) / 10,
        " µm apart; tooth_thinning_mm = 0 counts no backlash, so back flanks are left out: give the gears theirs to see where they would touch");
  if (s.backlash_margin <= 0) {
    std::map<double, bool> beyond;
    const Eigen::VectorXd left = backlash_left(s);
    for (Eigen::Index i = 0; i < left.size(); ++i) beyond[s.mesh_frequency[i]] = left[i] <= 0;
    add(true, "at ", speed_ranges(beyond), " Hz the motion goes up to ",
        std::round(-s.backlash_margin * 1e8) / 100,
        " µm beyond the backlash; back flanks would touch there, which is not modelled");
  }
  return out;
}

}  // namespace whine
