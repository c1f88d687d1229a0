// Numerical stability of statics and motion: round-off over a million steps, shorter steps, multipliers over another cut of the period and near
// grazing, damping and torque over many decades, few and many teeth.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dynamics/period_map.h"
#include "gear/iso6336.h"
#include "hard_cases/gears.h"
#include "hard_cases/table.h"

using namespace whine;
using namespace whine::hard_cases;

namespace {

constexpr double kPi = std::numbers::pi;
using State = RollingDynamics::State;

// 7813 mesh periods of 128 steps are 1e6 steps.
void a_million_steps(Table& table) {
  for (const double frequency : {3200.0, 2550.0}) {
    Rolling pair(150, 128);
    pair.dynamics.set_speed(frequency, 128);
    RollingDynamics::Period period;
    const State early = after(pair, pair.dynamics.rest(), 600, period);
    const double mean = period.transmission_error.mean(), swing = rms(period.transmission_error);
    const State late = after(pair, early, 7213, period);
    const std::string at = text("gears at ", frequency, " Hz, ");
    table.at_most(at + "state after 1e6 steps against that after 8e4, relative", 1e-11,
                  pair.dynamics.distance(early, late));
    table.absolute(at + "mean of the transmission error, relative", 0,
                   period.transmission_error.mean() / mean - 1, 1e-12);
    table.absolute(at + "RMS of it, relative", 0, rms(period.transmission_error) / swing - 1, 1e-11);
    table.at_most(at + "steps that block pivoting alone could not solve in the last period", 0,
                  period.fallbacks);
  }
}

void shorter_steps(Table& table) {
  const auto jump = [](int steps) {
    SweepParameters settings = sweep_parameters(2760, 2810, 10, 5.5e-6);
    settings.time.steps_per_period = steps;
    const SweepResult result = run_sweep(settings, 150);
    return result.jump_frequency.size() == 1 ? result.jump_frequency[0] : 0;
  };
  const double finest = jump(1024);
  table.at_least("jump with rising speed, 1024 steps a period, Hz", 2760, finest);
  for (const int steps : {128, 256, 512})
    table.absolute(text("jump with rising speed, ", steps, " steps a period, Hz, against 1024"), finest,
                   jump(steps), steps == 128 ? 1 : 0.5);
}

// At the mesh frequency at which the least mesh force becomes 0, on the branch with contact.
void near_grazing(Table& table) {
  Rolling pair(150, 128);
  RollingDynamics::Period period;
  const auto settled = [&](double frequency) {
    pair.dynamics.set_speed(frequency, 128);
    return after(pair, pair.dynamics.rest(), 300, period);
  };
  const auto least_force = [&](double frequency) {
    settled(frequency);
    return period.tooth_pair_load.colwise().sum().minCoeff();
  };
  double holds = 2850, parts = 2900;
  table.at_most("gears at 2900 Hz: least mesh force, N", 0, least_force(parts));
  table.at_least("gears at 2850 Hz: least mesh force, N", 1, least_force(holds));
  while (parts - holds > 0.01) {
    const double middle = 0.5 * (parts + holds);
    (least_force(middle) > 0 ? holds : parts) = middle;
  }
  const double before = largest_multiplier(pair, settled(holds - 0.02), 1e-8),
               beyond = largest_multiplier(pair, settled(parts + 0.02), 1e-8);
  table.at_most("largest multiplier 0.02 Hz below the speed at which teeth begin to part", 1, before);
  table.relative("the same 0.02 Hz above: a force without a step keeps it continuous", before, beyond, 0.02);

  RollingPeriodMap map(pair.dynamics, 128);
  map.set_parameter(parts + 0.02);
  map.apply(map.flat(settled(parts + 0.02)));
  const double exact = general_eigenvalues(map.tangent()).values.cwiseAbs().maxCoeff();
  table.relative("the same by the exact tangent", exact, beyond, 1e-4);
  for (const int cut : {31, 64, 100})
    table.relative(text("the same of the period cut at the end of step ", cut), exact,
                   general_eigenvalues(map.tangent_from(cut)).values.cwiseAbs().maxCoeff(), 1e-8);
}

void damping_of_all_sizes(Table& table) {
  // Rayleigh by mass: zeta = mu / (2 omega).
  const auto at = [](double ratio, double frequency) {
    SweepParameters settings = sweep_parameters(frequency, frequency, 1, 1e-9);
    settings.damping.rayleigh_mass = 2 * ratio * 2 * kPi * 2700;
    return run_sweep(settings, 150);
  };
  const SweepResult little = at(1e-4, 3700), more = at(1e-3, 3700);
  table.at_least("damping 1e-4 of critical, 3700 Hz: period multiple (0: not steady)", 1,
                 little.period_multiple[0]);
  table.at_most("its energy balance, relative", 1e-9, little.energy_imbalance[0]);
  table.relative("its RMS, um, far from resonance that of 1e-3", 1e6 * rms(more.transmission_error[0].col(0)),
                 1e6 * rms(little.transmission_error[0].col(0)), 0.01);
  const StaticResult fixed = statics(150);
  for (const double ratio : {0.1, 1.0, 10.0}) {
    const SweepResult result = at(ratio, 2700);
    table.at_least(text("damping ", ratio, " of critical, 2700 Hz: period multiple"), 1,
                   result.period_multiple[0]);
    table.at_most("its energy balance, relative", 1e-9, result.energy_imbalance[0]);
    if (ratio >= 1)
      table.at_most("its RMS over that of the static transmission error", 1,
                    rms(result.transmission_error[0].col(0)) / rms(fixed.transmission_error));
  }
}

// One pair in contact: Hertz adds 2 / (pi E b) ln 10 to the compliance with each decade of torque that is taken away.
void torques_of_all_sizes(Table& table) {
  const double decade = 2 / (kPi * kYoung * kFaceWidth) * std::log(10.0);
  double before = 0;
  for (int power = -3; power <= 3; ++power) {
    const double torque = std::pow(10.0, power);
    const StaticResult at = statics(torque, 16, false);
    const double compliance = at.transmission_error[0] / torque * kBaseRadius;
    table.absolute(text(torque, " N m: sum of tooth loads over torque / base radius"), 1,
                   at.tooth_load.rowwise().sum().mean() * kBaseRadius / torque, 1e-9);
    if (power > -3)
      table.relative(text(torque, " N m: compliance lost since the decade before, over Hertz's"), 1,
                     (before - compliance) / decade, 0.01);
    before = compliance;
  }
  for (const double torque : {1e-3, 1e3}) {
    const SweepResult result = run_sweep(sweep_parameters(3700, 3700, 1, 7.7e-6), torque);
    table.at_least(text(torque, " N m, 3700 Hz: period multiple (0: not steady)"), 1,
                   result.period_multiple[0]);
    table.at_most("its energy balance, relative", 1e-9, result.energy_imbalance[0]);
  }
}

// Pairs of equal gears of one diameter at one torque and face width, so of one line load. The rigid bore stands three modules below the pitch
// circle: the norm, whose gears are solid, counts more and more of a body that is not there as teeth become small.
void teeth_of_all_numbers(Table& table) {
  for (const int teeth : {12, 17, 50, 150, 300}) {
    GearDesign gear = paper_gear(teeth);
    gear.module = 150e-3 / teeth;
    gear.profile_shift = teeth < 17 ? 0.3 : 0;
    gear.bore_radius = 0.5 * gear.module * (teeth - 6);
    BodyDiscretisation discretisation;
    discretisation.element_size = gear.module / 4;
    const ReducedBody body = reduce(make_sector_mesh(gear, discretisation), steel(true), 5);
    StaticParameters settings = static_parameters(32, false);
    // Involutes without backlash: inv a' = inv a + 2 tan a (x1 + x2) / (z1 + z2).
    const double alpha = gear.pressure_angle,
                 target = std::tan(alpha) - alpha + 2 * std::tan(alpha) * gear.profile_shift / teeth;
    double working = alpha;
    for (int i = 0; i < 50; ++i)
      working -= (std::tan(working) - working - target) / std::pow(std::tan(working), 2);
    settings.mesh.centre_distance = 0.150 * std::cos(alpha) / std::cos(working);
    const StaticResult at = static_transmission(body, body, settings, 150);
    const double iso =
        kFaceWidth * iso_6336_stiffness(gear, steel(true), gear, steel(true), 150, at.contact_ratio).mesh;
    const std::string name = text(teeth, " teeth of module ", 1e3 * gear.module, " mm: ");
    table.absolute(name + "sum of tooth loads over torque / base radius", 1,
                   (at.tooth_load.rowwise().sum().array() * kBaseRadius / 150 - 1).abs().maxCoeff() + 1,
                   1e-9);
    table.relative(name + "mean stiffness over the theoretical one, c_gamma_alpha / C_M, of ISO 6336-1", 1,
                   0.8 * at.stiffness_secant.mean() / iso, 0.2);
    SweepParameters motion = sweep_parameters(300, 300, 1, 7.7e-6);
    motion.inertia[0] = motion.inertia[1] = 0.03;
    const SweepResult rolling = sweep(body, body, at, at.stiffness_secant.mean(), motion, Direction::up,
                                      [](long, long, const std::string&) {});
    table.at_least(name + "300 Hz: period multiple (0: not steady)", 1, rolling.period_multiple[0]);
    table.at_most(name + "energy balance, relative", 1e-9, rolling.energy_imbalance[0]);
  }
}

}  // namespace

std::vector<HardCase> whine::numerical_stability() {
  return {{"1e6", a_million_steps},       {"steps", shorter_steps},          {"grazing", near_grazing},
          {"zeta", damping_of_all_sizes}, {"decades", torques_of_all_sizes}, {"teeth", teeth_of_all_numbers}};
}
