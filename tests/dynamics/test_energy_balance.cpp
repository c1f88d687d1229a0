// The energy balance of integrated periods: it closes, its numerical lines fall with the step, it takes no memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "memory.h"
#include "paper_pair.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

struct Rig {
  Rig(ContactModel contact, double eta)
      : model(paper_body(), paper_body(), paper_statics(128).mesh), dynamics(model, [&] {
          const SweepParameters settings = paper_sweep(2900, 2900, 1);
          DynamicParameters parameters;
          parameters.torque = 150;
          parameters.inertia.assign(settings.inertia.begin(), settings.inertia.end());
          parameters.mean_stiffness = 463e6;
          parameters.damping = settings.damping;
          parameters.damping.rayleigh_stiffness = eta;
          parameters.fidelity = settings.fidelity;
          parameters.fidelity.contact = contact;
          return parameters;
        }()) {}

  // From rest; the candidate zone and the corner range widen until they hold the motion.
  void start(double frequency, int steps, int periods) {
    const double load = 150 / model.kinematics.gear(0).base_radius();
    for (double wide = 2.5; wide < 50; wide *= 1.6) {
      dynamics.set_zone(
          candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), 8,
                         load / model.kinematics.contact_ratio(), wide * load, wide * 6e-6),
          steps);
      state = dynamics.rest();
      dynamics.set_speed(frequency, steps);
      int done = 0;
      while (done < periods && dynamics.integrate(state, period)) ++done;
      if (done == periods) return;
    }
    FAIL("no candidate zone holds the motion");
  }

  GearMeshModel model;
  RollingDynamics dynamics;
  RollingDynamics::State state;
  RollingDynamics::Period period;
};

}  // namespace

TEST_CASE("the energy balance closes to 1e-9 of the input energy over 1e5 steps in which contact is lost") {
  constexpr int kSteps = 128, kPeriods = 100000 / kSteps + 1;
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    Rig rig(contact, 5.5e-6);
    rig.start(2900, kSteps, 5);
    EnergyBalance energy_balance;
    double least = 1;
    for (int i = 0; i < kPeriods; ++i) {
      REQUIRE(rig.dynamics.integrate(rig.state, rig.period, &energy_balance));
      least = std::min(least, rig.period.tooth_pair_load.colwise().sum().minCoeff());
    }
    INFO(contact << ": " << energy_balance.left_over() << " J of " << energy_balance.throughput);
    CHECK(least == 0);
    CHECK(energy_balance.throughput > 0.1);
    CHECK(std::abs(energy_balance.left_over()) < 1e-9 * energy_balance.throughput);
    CHECK(energy_balance.imbalance < 1e-9 * energy_balance.throughput / kPeriods);
  }
}

TEST_CASE(
    "stiff damping: the energy balance closes with the relaxed load that is dropped in a line of its own") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    StaticParameters statics_parameters = paper_statics(128);
    statics_parameters.contact.strips = 8;
    statics_parameters.fidelity.contact = contact;
    const StaticResult statics = static_transmission(paper_body(), paper_body(), statics_parameters, 150);
    SweepParameters settings = paper_sweep(2500, 2500, 1);
    settings.fidelity.contact = contact;
    settings.damping.rayleigh_stiffness = 1e-4;  // a quarter of the mesh period, the most that is computed
    const SweepResult result = sweep(paper_body(), paper_body(), statics, 463e6, settings, Direction::up,
                                     [](long, long, const std::string&) {});
    const double input = std::abs(result.energy(0, energy_line("rolling"))),
                 dropped = result.energy(0, energy_line("dropped"));
    INFO(contact << ": dropped " << dropped << " J of " << input);
    CHECK(result.period_multiple[0] >= 1);
    CHECK(result.energy_imbalance[0] < 1e-9);
    // Without its line this much would be left over.
    CHECK(-dropped > 1e-8 * input);
  }
}

TEST_CASE(
    "the scheme's own lines of the energy balance fall with the square of the step, where contact is lost, too") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    std::vector<double> step, switching, averaging;
    for (int steps = 128; steps <= 2048; steps *= 2) {
      Rig rig(contact, 5.5e-6);
      rig.start(2900, steps, 200);
      CHECK(rig.period.tooth_pair_load.colwise().sum().minCoeff() == 0);
      EnergyBalance energy_balance;
      REQUIRE(rig.dynamics.integrate(rig.state, rig.period, &energy_balance));
      CHECK(energy_balance.cutting[0] == 0);
      step.push_back(-std::log(steps));
      switching.push_back(std::log(std::abs(energy_balance.switching[0]) / energy_balance.throughput));
      averaging.push_back(std::log(std::abs(energy_balance.averaging) / energy_balance.throughput));
    }
    const auto order = [&](const std::vector<double>& line) {
      const Eigen::Map<const Eigen::ArrayXd> x(step.data(), step.size()), y(line.data(), line.size());
      return ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
    };
    INFO(contact << ": switching of order " << order(switching) << ", averaging " << order(averaging));
    CHECK(order(switching) > 1.75);
    CHECK(order(averaging) > 1.75);
  }
}

TEST_CASE("a mesh period takes no memory, with an energy balance or without") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    Rig rig(contact, 5.5e-6);
    rig.start(2900, 128, 5);
    EnergyBalance energy_balance;
    REQUIRE(
        rig.dynamics.integrate(rig.state, rig.period, &energy_balance));  // which takes memory for its lists
    for (EnergyBalance* kept : {static_cast<EnergyBalance*>(nullptr), &energy_balance}) {
      const long before = memory_requests;
      for (int i = 0; i < 5; ++i) REQUIRE(rig.dynamics.integrate(rig.state, rig.period, kept));
      CHECK(memory_requests - before == 0);
    }
  }
}
