// A gear with a cracked tooth: root stress, convergence of its tables, the turn in which the tooth comes round; in motion, as a pair and as
// a train.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cracked_gear.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "paper_pair.h"
#include "relative.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "solid/crack.h"
#include "solid/flank_table.h"
#include "solid/reduce.h"
#include "studies/runup.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace {

using namespace whine;
using Eigen::Index;

constexpr double kTorque = 150;

// Pa N-1: largest along the root of the cracked tooth (0) or of one beside it, under a force at the middle of its own flank.
double largest(double element, double depth, int tooth) {
  const ReducedBody body = reduce(sector_of(cracked_gear(depth), element), kSteel, 0);
  const Index n = body.flank_position.size(), roots = body.root_angle.size(), place = body.offsets + tooth;
  return (body.root_stress[static_cast<size_t>(body.offsets)].topRows(roots) +
          body.crack_root_stress.block(place * roots, place * n, roots, n))
      .col(n / 2)
      .maxCoeff();
}

}  // namespace

TEST_CASE(
    "root stress of a cracked gear: it converges with the elements, on the cracked tooth and beside it") {
  // Within 3 % of what an intact tooth has, and as near as that tooth itself.
  const double intact = largest(0.8e-3, 2e-3, 3);
  CHECK(std::abs(largest(0.8e-3, 2e-3, 0) - largest(0.4e-3, 2e-3, 0)) < 0.03 * intact);
  CHECK(largest(0.8e-3, 2e-3, 1) == relative(largest(0.4e-3, 2e-3, 1), 1e-2));
}

TEST_CASE(
    "root stress of a cracked gear: over a turn the cracked tooth has less, its neighbours little more, the others the same") {
  constexpr int kPositions = 8, kTeeth = 50;
  const StaticParameters settings = paper_statics(kPositions);
  const StaticResult intact = static_transmission(cracked_body(0), cracked_body(0), settings, kTorque);
  CHECK(intact.root_stress_tooth.size() == 0);
  double beside = 0;
  for (const int gear : {0, 1})
    for (const int tooth : {0, 3}) {
      CAPTURE(gear);
      CAPTURE(tooth);
      const ReducedBody& cracked = cracked_body(2e-3, tooth);
      const StaticResult s = gear == 0 ? static_transmission(cracked, cracked_body(0), settings, kTorque)
                                       : static_transmission(cracked_body(0), cracked, settings, kTorque);
      const auto g = static_cast<size_t>(gear);
      REQUIRE(s.root_stress[g].rows() == kTeeth * kPositions);
      const auto of_tooth = [&](int number) {
        double most = 0;
        for (Index i = 0; i < s.root_stress[g].rows(); ++i)
          for (Index k = 0; k < s.pair.size(); ++k) {
            const int pair = s.pair[k] - static_cast<int>(i) / kPositions, at = gear == 0 ? pair : -pair;
            if (s.tooth_load(i, k) > 0 && ((at - number) % kTeeth + kTeeth) % kTeeth == 0)
              most = std::max(most, s.root_stress[g](i, k));
          }
        return most;
      };
      const double whole = intact.root_stress_max[gear];
      for (int k = 6; k < kTeeth - 6; ++k) CHECK(of_tooth(tooth + k) == whole);
      CHECK(of_tooth(tooth) < 0.4 * whole);
      CHECK(of_tooth(tooth) > 0.02 * whole);
      const double next = std::max(of_tooth(tooth + 1), of_tooth(tooth - 1));
      CHECK(next > whole);
      CHECK(next < 1.02 * whole);
      CHECK(s.root_stress_max[gear] == next);
      const int named = ((s.root_stress_tooth[gear] - tooth) % kTeeth + kTeeth) % kTeeth;
      CHECK((named == 1 || named == kTeeth - 1));
      // Both gears are alike, and so are all places of the crack.
      if (beside > 0) CHECK(next == relative(beside, 1e-6));
      beside = next;
    }
}

TEST_CASE(
    "root stress of a cracked gear: the deeper the slit, the less is left beside it and the more its neighbours bear") {
  const StaticParameters settings = paper_statics(8);
  double last = 0;
  for (const double depth : {1e-3, 2e-3, 3e-3}) {
    const StaticResult s = static_transmission(cracked_body(depth), cracked_body(0), settings, kTorque);
    CHECK(s.root_stress_max[0] > last);
    last = s.root_stress_max[0];
  }
}

TEST_CASE("root stress of a cracked gear: no crack, no table; without its table none is given") {
  CHECK(cracked_body(0).crack_root_stress.size() == 0);
  ReducedBody lacking = cracked_body(2e-3);
  lacking.crack_root_stress.resize(0, 0);
  const StaticResult s = static_transmission(lacking, cracked_body(0), paper_statics(8), kTorque);
  CHECK(s.root_stress_max.size() == 0);
  CHECK(s.root_stress[0].size() == 0);
}

namespace {

// With modes for motion; the crack is in tooth 3.
const ReducedBody& moving_body(bool cracked) {
  GearDesign design = cracked_gear(cracked ? 2e-3 : 0);
  design.crack.tooth = 3;
  return kept_body(design, kSteel, 1.2e-3, 7);
}

// The driver has the crack; 64 steps a mesh period.
SweepParameters cracked_pair(ContactModel contact, double frequency) {
  SweepParameters settings = paper_sweep(frequency, frequency, 1);
  settings.fidelity = {BodyModel::modal, contact, Integrator::exact};
  settings.time.steps_per_period = 64;
  settings.time.min_sample_rate = 0;
  return settings;
}

StaticResult cracked_statics(ContactModel contact) {
  StaticParameters at_rest = paper_statics(64);
  at_rest.fidelity.contact = contact;
  return static_transmission(moving_body(true), moving_body(false), at_rest, kTorque);
}

SweepResult cracked_sweep(ContactModel contact, double frequency) {
  const StaticResult s = cracked_statics(contact);
  return sweep(moving_body(true), moving_body(false), s, s.mean_stiffness, cracked_pair(contact, frequency),
               Direction::up, no_report);
}

SystemSweepParameters cracked_train(double frequency) {
  Scene scene;
  for (const char* name : {"pinion", "wheel"}) {
    SceneGear& gear = scene.gears.emplace_back();
    gear.name = name;
    gear.design = moving_body(scene.gears.size() == 1).design;
    gear.material = paper_steel();
    gear.total_inertia = 0.0148;
  }
  scene.meshes.resize(1);
  scene.meshes[0].spec = paper_statics(64).mesh;
  scene.drives = {{"pinion", System::DriveKind::torque, kTorque, 0},
                  {"wheel", System::DriveKind::torque, -kTorque, 0}};
  scene.operation.frequency_from = scene.operation.frequency_to = frequency;
  scene.operation.frequency_step = 1;
  scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  scene.contact = {17, 64};
  scene.damping.rayleigh_stiffness = 7.7e-6;
  scene.time.steps_per_period = 64;
  scene.time.min_sample_rate = 0;
  return sweep_parameters_of(scene, layout_of(scene));
}

SweepResult cracked_train_sweep(double frequency) {
  return system_sweep(cracked_train(frequency), {moving_body(true), moving_body(false)}, Direction::up,
                      no_report);
}

struct KeptMotion : RunupSink {
  RunupPeriods periods;
  void begin(const RunupResult&, Index, Index) override {}
  void take(const RunupSamples&) override {}
  void take(const RunupPeriods& all) override { periods = all; }
  void end(const RunupResult&) override {}
};

Eigen::VectorXd residual_of(const SweepResult& a) {
  return residual_signal(a.transmission_error[0].col(0), a.hunting_periods);
}

double rms_of(const Eigen::VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

}  // namespace

// A slow motion is that of the statics, but for the vibration after each tooth that comes in.
TEST_CASE(
    "a cracked tooth in motion: slow, the residual signal is that at rest; lines, strips and a train have one") {
  constexpr int kTeeth = 50;
  constexpr double kSlow = 150;
  StaticParameters at_rest = paper_statics(64);
  const StaticResult s = static_transmission(moving_body(true), moving_body(false), at_rest, kTorque);
  const Eigen::VectorXd rest = residual_signal(s.transmission_error, kTeeth);
  const SweepResult strips = cracked_sweep(ContactModel::strips, kSlow),
                    lines = cracked_sweep(ContactModel::line, kSlow), train = cracked_train_sweep(kSlow);
  for (const SweepResult* a : {&strips, &lines, &train}) {
    REQUIRE(a->hunting_periods == kTeeth);
    REQUIRE(a->period_multiple[0] == kTeeth);
    REQUIRE(a->samples() == kTeeth * 64);
    CHECK(a->energy_imbalance[0] < 1e-9);
    const ResponseResult r = response(*a);
    MESSAGE("residual " << r.residual_rms(0, 0) * 1e9 << " nm, at rest " << rms_of(rest) * 1e9
                        << ", kurtosis " << r.residual_kurtosis(0, 0) << ", at rest " << kurtosis(rest)
                        << "; apart " << rms_of(residual_of(*a) - rest) / rms_of(rest) << ", of lines "
                        << rms_of(residual_of(*a) - residual_of(lines)) / rms_of(rest));
    CHECK(rms_of(residual_of(*a) - rest) < 0.2 * rms_of(rest));
    CHECK(r.residual_rms(0, 0) == relative(rms_of(rest), 0.02));
    CHECK(r.residual_kurtosis(0, 0) == relative(kurtosis(rest), 0.15));
    CHECK(r.residual_kurtosis(0, 0) > 10);
    // Sidebands a turn of the gear apart, beside the mesh and low; an intact pair has none.
    for (const Index order : {1, 2, kTeeth - 1, kTeeth + 1})
      CHECK(r.dte_order[0](order - 1, 0) > 1e-2 * rms_of(rest));
  }
  CHECK(rms_of(residual_of(train) - residual_of(lines)) < 1e-2 * rms_of(rest));
  // The root of the cracked tooth, in motion as at rest.
  const Eigen::VectorXd known = s.root_stress[0].rowwise().maxCoeff();
  CHECK((strips.root_stress[0].col(0) - known).cwiseAbs().maxCoeff() < 0.06 * known.maxCoeff());
}

TEST_CASE("a cracked tooth in motion: near resonance a pair and a train of two gears move alike") {
  const SweepResult lines = cracked_sweep(ContactModel::line, 2000), train = cracked_train_sweep(2000);
  const Eigen::VectorXd one = lines.transmission_error[0].col(0), other = train.transmission_error[0].col(0);
  REQUIRE(one.size() == other.size());
  CHECK(rms_of(one - other) < 1e-2 * rms_of(residual_of(lines)));
  CHECK(lines.energy_imbalance[0] < 1e-9);
  CHECK(train.energy_imbalance[0] < 1e-9);
}

TEST_CASE("a cracked tooth in a run-up: a pair and a train of two gears show it in the same mesh periods") {
  constexpr double kFrom = 1000, kTo = 1080;
  const StaticResult s = cracked_statics(ContactModel::line);
  RunupSettings wanted;
  wanted.ramp = {kFrom, kTo, 1500};
  wanted.sample_rate = 24000;
  KeptMotion pair, train;
  runup(moving_body(true), moving_body(false), s, s.mean_stiffness, cracked_pair(ContactModel::line, kFrom),
        wanted, pair, no_report);
  runup(cracked_train(kFrom), {moving_body(true), moving_body(false)}, wanted, train, no_report);
  REQUIRE(pair.periods.size() > 60);
  REQUIRE(pair.periods.size() == train.periods.size());
  const Eigen::VectorXd known = pair.periods.dte_mean.col(0), found = train.periods.dte_mean.col(0);
  Index at = 0, own = 0;
  const double most = known.maxCoeff(&at);
  found.maxCoeff(&own);
  CHECK(own == at);
  CHECK(most - known.minCoeff() > 0.02 * most);  // the cracked tooth gives way
  CHECK((found - known).norm() < 1e-3 * known.norm());
}
