// Friction in motion: energy, losses, the problems of the steps, the tangent of the period map.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "base/dense.h"
#include "contact/friction.h"
#include "dynamics/period_map.h"
#include "friction_motion.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "relative.h"
#include "signal/response.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kFriction = 0.06;

const ReducedBody& coarse_body() {
  return paper_body(40e-3, 1.2e-3, 12);
}

StaticParameters with_friction(double coefficient, ContactModel contact, bool bearings = false) {
  StaticParameters settings = paper_statics(32);
  settings.fidelity.contact = contact;
  settings.mesh.friction.coefficient = coefficient;
  if (bearings) settings.mesh.bearing = {Bearing{200e6, 500, 0}, Bearing{120e6, 700, 0}};
  return settings;
}

// The paper's pair at 150 N m on coarse elements.
FrictionMotion motion_of(double coefficient, ContactModel contact, BodyModel body = BodyModel::modal,
                         bool bearings = false, double eta = 4e-6) {
  return FrictionMotion(
      coarse_body(), coarse_body(),
      static_transmission(coarse_body(), coarse_body(), with_friction(coefficient, contact, bearings), 150),
      {0.0148, 0.0148}, body, eta);
}

}  // namespace

TEST_CASE(
    "friction in motion: the energy balance closes with what friction takes, where contact is lost, too") {
  for (const auto contact : {ContactModel::strips, ContactModel::line})
    for (const bool bearings : {false, true}) {
      FrictionMotion rig = motion_of(kFriction, contact, BodyModel::modal, bearings);
      rig.start(2900, 128, 40);
      EnergyBalance balance;
      double least = 1, loads = 0;
      for (int i = 0; i < 20; ++i) {
        REQUIRE(rig.dynamics.integrate(rig.state, rig.period, &balance));
        least = std::min(least, rig.period.tooth_pair_load.colwise().sum().minCoeff());
        loads += rig.period.tooth_pair_load.sum() / 128;
      }
      INFO(contact << ", bearings " << bearings << ": " << balance.left_over() << " J of "
                   << balance.throughput << ", friction " << balance.friction.sum() << " J, rolling "
                   << balance.friction_rolling);
      if (!bearings) CHECK(least == 0);
      CHECK(balance.friction.sum() > 0);
      CHECK(std::abs(balance.left_over()) < 1e-9 * balance.friction.sum());
      CHECK(balance.imbalance < 1e-9 * balance.throughput);
      // The mean force is that of the torque, and the balance of the loss is no small part of it.
      CHECK(loads / 20 == relative(150 / rig.model.kinematics.gear(0).base_radius(), 0.05));
      CHECK(balance.friction.sum() > 1e-3 * balance.throughput);
    }
}

TEST_CASE(
    "friction in motion: work put in less work given is the integral of mu N v, by the motion of rigid gears") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    constexpr int kSteps = 128;
    constexpr double kFrequency = 2500;
    FrictionMotion rig = motion_of(kFriction, contact, BodyModel::rigid, false, 0);
    rig.start(kFrequency, kSteps, 30);
    const GearPair& pair = rig.model.kinematics;
    EnergyBalance balance;
    RollingDynamics::Period before = rig.period, now;
    REQUIRE(rig.dynamics.integrate(rig.state, now, &balance));
    // Equal gears and inertias: both turn by half of the transmission error.
    const double rb = pair.gear(0).base_radius(), turn = 2 * std::numbers::pi / 50 / kSteps;
    double loss = 0, in = 0, out = 0;
    const int reach = static_cast<int>(now.tooth_pair_load.rows()) / 2;
    const auto at = [&](int step) {  // sample 0 of a period is its end, in the names of the next
      struct {
        VectorXd load;
        double error;
      } sample{step == kSteps ? VectorXd(now.tooth_pair_load.col(0))
               : step == 0    ? VectorXd(before.tooth_pair_load.col(0))
                              : VectorXd(now.tooth_pair_load.col(step)),
               step == kSteps ? now.transmission_error[0]
               : step == 0    ? before.transmission_error[0]
                              : now.transmission_error[step]};
      return sample;
    };
    struct Moments {
      double driver = 0, driven = 0, first = 0, second = 0;  // contact; friction
    };
    const auto moments = [&](int step) {
      Moments m;
      const auto sample = at(step);
      for (int slot = 0; slot < sample.load.size(); ++slot) {
        if (!(sample.load[slot] > 0)) continue;
        const PairContact touch = pair.contact(static_cast<double>(step % kSteps) / kSteps + slot - reach);
        const PairSliding slides = sliding_of(pair, touch, 0.01);
        m.driver += sample.load[slot] * touch.lever[0];
        m.driven += sample.load[slot] * touch.lever[1];
        m.first += kFriction * sample.load[slot] * slides.direction * slides.lever[0];
        m.second += kFriction * sample.load[slot] * slides.direction * slides.lever[1];
      }
      return m;
    };
    for (int step = 1; step <= kSteps; ++step) {
      const Moments a = moments(step - 1), b = moments(step);
      const double half = 0.5 * (at(step).error - at(step - 1).error) / (2 * rb);  // of a mean of two moments
      const double driver = 0.5 * turn + half, driven = 0.5 * turn - half;
      loss += (a.first + b.first) * driver - (a.second + b.second) * driven;
      in += (a.driver + b.driver + a.first + b.first) * driver;
      out += (a.driven + b.driven + a.second + b.second) * driven;
    }
    INFO(contact << ": " << balance.friction.sum() << " J, by the motion " << loss << " J");
    CHECK(balance.friction.sum() == relative(loss, 1e-9));
    // What the mesh takes: friction, and what the normal forces do on gaps that close and open.
    CHECK(in - out > 0.5 * loss);
  }
}

namespace {

// The problem of a step: by its active strips, and by the iteration from nothing. Returns the size of what friction adds.
double check_problem(const RollingDynamics::ContactProblem& problem, const VectorXd& offset, bool recorded) {
  const MatrixXd whole = problem.compliance + problem.friction;
  const double scale = offset.cwiseAbs().maxCoeff();
  ComplementaritySolver solver;
  ActiveSet fresh;
  VectorXd force = VectorXd::Zero(offset.size()), gap = force, shift = force;
  int solves = 0;
  solve_with_friction(
      shift, scale,
      [&](const VectorXd& by) {
        ++solves;
        return solver.solve(problem.compliance, offset + by, fresh, force, gap);
      },
      [&] { return VectorXd(problem.friction * force); });
  CHECK(solves <= 6);
  const VectorXd d = whole * force + offset;
  CHECK(force.minCoeff() >= 0);
  CHECK(d.minCoeff() > -1e-11 * scale);
  CHECK(force.cwiseProduct(d).cwiseAbs().maxCoeff() <= 1e-11 * scale * force.maxCoeff());
  if (recorded) {
    const std::vector<int>& active = problem.active.strips;
    VectorXd p = VectorXd::Zero(whole.rows());
    if (!active.empty()) p(active) = -lu_solve(whole(active, active), offset(active));
    CHECK((force - p).norm() < 1e-8 * p.norm() + 1e-12);
  }
  return problem.friction.norm() / problem.compliance.norm();
}

}  // namespace

// Beside the recorded problems those with gaps that are off by up to a fifth, ten of each.
TEST_CASE(
    "friction in motion: recorded problems of steps hold as a whole, at speeds with and without contact loss") {
  FrictionMotion rig = motion_of(0.1, ContactModel::strips, BodyModel::modal, true);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.8, 1.2);
  int problems = 0, parted = 0;
  double most = 0;
  for (const double frequency : {700.0, 1100.0, 2500.0, 2900.0}) {
    rig.start(frequency, 64, 10);
    for (const RollingDynamics::ContactProblem& problem : rig.dynamics.contact_problems(rig.state)) {
      REQUIRE(problem.friction.size() > 0);
      most = std::max(most, check_problem(problem, problem.offset, true));
      parted += problem.active.strips.empty();
      for (int variant = 0; variant < 10; ++variant) {
        VectorXd offset = problem.offset;
        for (double& x : offset) x *= uniform(random);
        check_problem(problem, offset, false);
      }
      problems += 11;
    }
  }
  INFO(problems << " problems, " << parted << " recorded ones without contact; friction adds up to " << most
                << " of the compliance");
  CHECK(problems == 4 * 64 * 11);
  CHECK(most > 1e-5);
  CHECK(most < 0.05);
}

TEST_CASE("friction in motion: the tangent of the period map is that of central differences") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    FrictionMotion rig = motion_of(0.1, contact, BodyModel::modal, true, 7.7e-6);
    rig.start(1100, 64, 6);
    RollingPeriodMap map(rig.dynamics, 64);
    map.set_parameter(1100);
    VectorXd y = map.flat(rig.state);
    for (int i = 0; i < 4; ++i) y = map.apply(y);
    map.apply(y);
    const auto sets = map.active_sets();
    const MatrixXd tangent = map.tangent();
    int compared = 0;
    for (int which = 0; which < 3; ++which) {
      VectorXd direction(map.size());
      for (int i = 0; i < direction.size(); ++i) direction[i] = std::sin(1.0 + 2.3 * i * (which + 1) + which);
      direction *= 1e-7 / direction.norm();
      const VectorXd ahead = map.apply(y + direction);
      const bool same = map.active_sets() == sets;
      const VectorXd behind = map.apply(y - direction);
      if (!same || map.active_sets() != sets) continue;
      ++compared;
      const VectorXd expected = 0.5 * (ahead - behind);
      INFO(contact << ", direction " << which);
      CHECK((tangent * direction - expected).norm() < 1e-6 * expected.norm());
    }
    CHECK(compared > 0);
  }
}

TEST_CASE("friction in motion: slow and light, losses are those at rest; a sweep keeps them") {
  const StaticResult s =
      static_transmission(coarse_body(), coarse_body(), with_friction(kFriction, ContactModel::line), 150);
  SweepParameters settings = paper_sweep(100, 100, 1);
  settings.fidelity.contact = ContactModel::line;
  settings.fidelity.body = BodyModel::relaxed;
  settings.time.min_sample_rate = 20e3;
  const SweepResult slow =
      sweep(coarse_body(), coarse_body(), s, s.mean_stiffness, settings, Direction::up, no_report);
  INFO("efficiency " << slow.friction.efficiency[0] << ", at rest " << s.efficiency);
  CHECK(1 - slow.friction.efficiency[0] == relative(1 - s.efficiency, 0.01));
  CHECK(slow.friction.coefficient[0] == kFriction);
  const double turning = 2 * std::numbers::pi * 100 / 50;
  CHECK(slow.friction.power[0] == relative((1 - slow.friction.efficiency[0]) * 150 * turning, 1e-12));
  CHECK(slow.energy_imbalance[0] < 1e-9);
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write(path, slow, Provenance());
  const SweepResult read = whine::read<SweepResult>(path);
  CHECK(read.friction.power == slow.friction.power);
  CHECK(read.energy == slow.energy);
  CHECK(read.energy(0, energy_line("friction")) > 0);
}

TEST_CASE(
    "friction in motion: a coefficient of 0 leaves every bit as it is without, a small one tends to that") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    const auto swept = [&](double coefficient, double smoothing) {
      StaticParameters statics = with_friction(coefficient, contact);
      statics.mesh.friction.smoothing = smoothing;
      const StaticResult s = static_transmission(coarse_body(), coarse_body(), statics, 150);
      SweepParameters settings = paper_sweep(2300, 2300, 1);
      settings.fidelity.contact = contact;
      settings.fidelity.body = BodyModel::relaxed;
      settings.time.min_sample_rate = 20e3;
      return sweep(coarse_body(), coarse_body(), s, s.mean_stiffness, settings, Direction::up, no_report);
    };
    const Friction untouched;
    const SweepResult without = swept(0, untouched.smoothing), none = swept(0, 0.5),
                      little = swept(1e-9, untouched.smoothing);
    CHECK(none.transmission_error == without.transmission_error);
    CHECK(none.mesh_force == without.mesh_force);
    CHECK(none.tooth_load == without.tooth_load);
    CHECK(none.friction.power.size() == 0);
    CHECK(none.energy(0, energy_line("friction")) == 0);
    REQUIRE(little.friction.power.size() == 1);
    CHECK(little.friction.power[0] > 0);
    CHECK((little.transmission_error[0] - without.transmission_error[0]).norm() <
          1e-6 * without.transmission_error[0].norm());
  }
}

TEST_CASE("friction in motion: with Schlenk's formula the energy balance closes at every speed") {
  StaticParameters statics = with_friction(0, ContactModel::line);
  Friction& friction = statics.mesh.friction;
  friction.law = FrictionLaw::schlenk;
  friction.viscosity = 0.015;
  friction.roughness = 0.5e-6;
  friction.static_frequency = 600;
  const StaticResult s = static_transmission(coarse_body(), coarse_body(), statics, 150);
  SweepParameters settings = paper_sweep(800, 1400, 600);
  settings.fidelity.contact = ContactModel::line;
  settings.fidelity.body = BodyModel::relaxed;
  settings.time.min_sample_rate = 20e3;
  const SweepResult swept =
      sweep(coarse_body(), coarse_body(), s, s.mean_stiffness, settings, Direction::up, no_report);
  REQUIRE(swept.energy_imbalance.size() == 2);
  CHECK(s.friction_coefficient > swept.friction.coefficient[0]);
  CHECK(swept.friction.coefficient[0] > swept.friction.coefficient[1]);
  for (Index row = 0; row < 2; ++row) {
    INFO(swept.mesh_frequency[row] << " Hz: " << swept.energy_imbalance[row]);
    CHECK(swept.energy_imbalance[row] < 1e-9);
  }
}

TEST_CASE("friction in motion: losses over mu tend to a limit of first order") {
  const auto loss = [](double mu) {
    FrictionMotion rig = motion_of(mu, ContactModel::line, BodyModel::relaxed, false, 7.7e-6);
    rig.start(2000, 64, 60);
    EnergyBalance balance;
    REQUIRE(rig.dynamics.integrate(rig.state, rig.period, &balance));
    return balance.friction.sum() / mu;
  };
  const double limit = loss(1e-5), fine = loss(0.01) - limit, coarse = loss(0.02) - limit;
  INFO("over mu " << limit << " J, off by " << fine << ", " << coarse);
  CHECK(std::abs(fine) < 0.02 * limit);
  CHECK(coarse / fine == relative(2, 0.1));
}
