// Orbits of several mesh periods of the elastic pair, near twice its natural frequency, where its stiffness excites it by parameter
// (Mathieu): beside the sweep that settles into them; a branch from a sweep's motion against that from the highest speed.
#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "signal/response.h"
#include "studies/branch.h"
#include "studies/sweep.h"
#include "system/statics.h"

using namespace whine;

namespace {

SweepParameters lightly_damped(double from, double to, double step) {
  SweepParameters settings = paper_sweep(from, to, step);
  settings.damping.rayleigh_stiffness = 2e-6;
  settings.time.periodicity = 1e-7;
  settings.time.steps_per_period = 64;
  settings.time.min_sample_rate = 0;
  return settings;
}

const StaticResult& coarse_statics() {
  static const StaticResult statics = [] {
    StaticParameters coarse = paper_statics(64);
    coarse.contact.strips = 8;
    return static_transmission(paper_body(), paper_body(), coarse, 150);
  }();
  return statics;
}

}  // namespace

TEST_CASE("subharmonics: beyond a period doubling the branch of two mesh periods is the motion of a sweep") {
  const SweepParameters settings = lightly_damped(5300, 6300, 50);
  const BranchResult branch = pair_branch(paper_body(), paper_body(), coarse_statics(), 463e6, settings,
                                          no_report, {.most_periods = 2});
  INFO(branch.end);
  REQUIRE(branch.flip_frequency.size() >= 2);
  const double high = branch.flip_frequency[0], low = branch.flip_frequency[1];
  MESSAGE("period doublings at " << high << " and " << low << " Hz; " << branch.mesh_frequency.size()
                                 << " orbits; " << branch.end);
  // Orbits of one period are unstable between the flips, and only there.
  int twice = 0;
  for (Eigen::Index i = 0; i < branch.mesh_frequency.size(); ++i) {
    const double f = branch.mesh_frequency[i];
    if (branch.period_multiple[i] == 1) CHECK((branch.stable[i] == 0) == (f > low && f < high));
    twice += branch.period_multiple[i] == 2;
  }
  CHECK(twice > 5);
  // A sweep in small steps through a part of the range settles into the orbit of two periods.
  const double at = 0.5 * (low + high);
  const SweepResult swept = sweep(paper_body(), paper_body(), coarse_statics(), 463e6,
                                  lightly_damped(at, at, 50), Direction::down, no_report);
  REQUIRE(swept.period_multiple[0] == 2);
  const ResponseResult response = whine::response(swept);
  double nearest = 1, sustained = 1;  // of the RMS; of what is sustained for 1/64 of a mesh period
  for (Eigen::Index i = 0; i + 1 < branch.mesh_frequency.size(); ++i) {
    const double a = branch.mesh_frequency[i], b = branch.mesh_frequency[i + 1];
    if (branch.period_multiple[i] != 2 || branch.part[i] != branch.part[i + 1] || (a - at) * (b - at) > 0)
      continue;
    const double share = (at - a) / (b - a),
                 rms = (1 - share) * branch.dte_rms(i, 0) + share * branch.dte_rms(i + 1, 0);
    nearest = std::min(nearest, std::abs(rms / response.dte_rms(0, 0) - 1));
    double apart = 0;
    const auto beside = [&](const Eigen::VectorXd& along, double swept_value) {
      apart = std::max(apart, std::abs(((1 - share) * along[i] + share * along[i + 1]) / swept_value - 1));
    };
    beside(branch.mesh_force_sustained.col(0), response.mesh_force_sustained(0, 0));
    for (Eigen::Index g = 0; g < kSides; ++g)
      beside(branch.root_stress_sustained.col(g), response.root_stress_sustained(0, g));
    sustained = std::min(sustained, apart);
  }
  CHECK(nearest < 0.01);
  MESSAGE("mesh force and root stress that two mesh periods hold: " << sustained);
  CHECK(sustained < 0.02);
}

TEST_CASE(
    "subharmonics: a branch from a sweep's motion is one that the branch from the highest speed is not joined to") {
  SweepParameters settings = lightly_damped(2300, 3000, 50);
  settings.damping.rayleigh_stiffness = 5.5e-6;
  const auto follow = [&](const BranchPlan& plan) {
    return pair_branch(paper_body(), paper_body(), coarse_statics(), 463e6, settings, no_report, plan);
  };
  // From the highest speed it leaves the range on the upper branch.
  CHECK(follow({}).fold_frequency.size() == 0);
  const BranchResult lower = follow({.sweep = Direction::up, .at = 2500});
  CHECK(lower.mesh_frequency[0] == relative(2500, 1e-12));
  CHECK(lower.stable[0]);
  REQUIRE(lower.fold_frequency.size() == 1);
  CHECK(lower.fold_frequency[0] > 2700);
  CHECK(lower.part.maxCoeff() == 1);
  for (int part = 0; part < 2; ++part) {
    Eigen::Index first = 0, last = lower.part.size() - 1;
    while (lower.part[first] != part) ++first;
    while (lower.part[last] != part) --last;
    CHECK(lower.mesh_frequency[first] == relative(2500, 1e-12));
    CHECK(lower.mesh_frequency[last] == relative(2300, 1e-12));
  }
  SweepParameters up = settings;
  up.frequency_to = 2500;
  const SweepResult swept =
      sweep(paper_body(), paper_body(), coarse_statics(), 463e6, up, Direction::up, no_report);
  CHECK(lower.dte_rms(0, 0) == relative(whine::response(swept).dte_rms.bottomRows(1)(0, 0), 1e-4));
  // What cannot be done is said.
  CHECK(failure_of([&] { follow({.sweep = Direction::up, .at = 1000}); }) == Failure::input);
  CHECK(failure_of([&] { follow({.most_periods = 3}); }) == Failure::input);
}
