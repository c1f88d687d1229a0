// The energy ledger of marched periods: it closes, its numerical lines fall with the step, it takes no memory.
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
          const SweepSlice slice = paper_sweep(2900, 2900, 1);
          DynamicParameters parameters;
          parameters.torque = 150;
          parameters.inertia = {slice.driver_inertia, slice.driven_inertia};
          parameters.mean_stiffness = 463e6;
          parameters.damping = slice.damping;
          parameters.damping.rayleigh_stiffness = eta;
          parameters.fidelity = slice.fidelity;
          parameters.fidelity.contact = contact;
          return parameters;
        }()) {}

  // From rest; the window and the corner range widen until they hold the motion.
  void start(double frequency, int steps, int periods) {
    const double load = 150 / model.kinematics.gear(0).base_radius();
    for (double wide = 2.5; wide < 50; wide *= 1.6) {
      dynamics.set_range(
          contact_range(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), 8,
                        load / model.kinematics.contact_ratio(), wide * load, wide * 6e-6),
          steps);
      state = dynamics.rest();
      dynamics.set_speed(frequency, steps);
      int done = 0;
      while (done < periods && dynamics.march(state, period)) ++done;
      if (done == periods) return;
    }
    FAIL("no window holds the motion");
  }

  GearMeshModel model;
  RollingDynamics dynamics;
  RollingDynamics::State state;
  RollingDynamics::Period period;
};

double left_over(const Ledger& l) {
  return l.storage() + l.modal_damping + l.lag_damping - l.torque - l.rolling - l.switching - l.cutting -
         l.forgetting + l.averaging;
}

}  // namespace

TEST_CASE("the ledger closes to 1e-9 of the input energy over 1e5 steps in which contact is lost") {
  constexpr int kSteps = 128, kPeriods = 100000 / kSteps + 1;
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    Rig rig(contact, 5.5e-6);
    rig.start(2900, kSteps, 5);
    Ledger ledger;
    double least = 1;
    for (int i = 0; i < kPeriods; ++i) {
      REQUIRE(rig.dynamics.march(rig.state, rig.period, &ledger));
      least = std::min(least, rig.period.pair_load.colwise().sum().minCoeff());
    }
    INFO(contact << ": " << left_over(ledger) << " J of " << ledger.throughput);
    CHECK(least == 0);
    CHECK(ledger.throughput > 0.1);
    CHECK(std::abs(left_over(ledger)) < 1e-9 * ledger.throughput);
    CHECK(ledger.imbalance < 1e-9 * ledger.throughput / kPeriods);
  }
}

TEST_CASE("stiff damping: the ledger closes with the lag that is forgotten in a line of its own") {
  const auto line = [](const char* name) {
    size_t i = 0;
    while (kEnergyLines[i].name != std::string(name)) ++i;
    return static_cast<Eigen::Index>(i);
  };
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    StaticSlice statics_slice = paper_statics(128);
    statics_slice.contact.strips = 8;
    statics_slice.fidelity.contact = contact;
    const StaticArtifact statics = static_transmission(paper_body(), paper_body(), statics_slice, 150);
    for (const double eta : {1e-4, 1e-3}) {
      SweepSlice slice = paper_sweep(2500, 2500, 1);
      slice.fidelity.contact = contact;
      slice.damping.rayleigh_stiffness = eta;
      const SweepArtifact result = sweep(paper_body(), paper_body(), statics, 463e6, slice, "up",
                                         [](long, long, const std::string&) {});
      const double input = std::abs(result.energy(0, line("rolling"))),
                   forgetting = result.energy(0, line("forgetting"));
      INFO(contact << ", " << eta << " s: forgetting " << forgetting << " J of " << input);
      CHECK(result.period_multiple[0] >= 1);
      CHECK(result.energy_imbalance[0] < 1e-9);
      // Without its line this much would be left over.
      CHECK(-forgetting > (eta > 5e-4 ? 1e-4 : 1e-8) * input);
    }
  }
}

TEST_CASE(
    "the scheme's own lines of the ledger fall with the square of the step, where contact is lost, too") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    std::vector<double> step, switching, averaging;
    for (int steps = 128; steps <= 2048; steps *= 2) {
      Rig rig(contact, 5.5e-6);
      rig.start(2900, steps, 200);
      CHECK(rig.period.pair_load.colwise().sum().minCoeff() == 0);
      Ledger ledger;
      REQUIRE(rig.dynamics.march(rig.state, rig.period, &ledger));
      CHECK(ledger.cutting == 0);
      step.push_back(-std::log(steps));
      switching.push_back(std::log(std::abs(ledger.switching) / ledger.throughput));
      averaging.push_back(std::log(std::abs(ledger.averaging) / ledger.throughput));
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

#ifdef WHINE_COUNTS_MEMORY
TEST_CASE("a mesh period takes no memory, with a ledger or without") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    Rig rig(contact, 5.5e-6);
    rig.start(2900, 128, 5);
    Ledger ledger;
    for (Ledger* kept : {static_cast<Ledger*>(nullptr), &ledger}) {
      const long before = memory_requests;
      for (int i = 0; i < 5; ++i) REQUIRE(rig.dynamics.march(rig.state, rig.period, kept));
      CHECK(memory_requests - before == 0);
    }
  }
}
#endif
