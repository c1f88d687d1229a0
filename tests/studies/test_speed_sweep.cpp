// The sweep over a rig with a known branch: where runs begin, where its motions jump.
#include "studies/speed_sweep.h"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "orbits/periodic_motion.h"
#include "relative.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

constexpr double kEnd = 137.3;  // Hz, of the upper branch

// A motion that is its RMS: f + 100 on the upper branch, to kEnd, and 50 elsewhere. A run stays on the branch of its state.
struct TwoBranches {
  using State = VectorXd;
  struct Motion {
    double rms = 0;
  };
  struct Acceleration {
    int runs = 0;  // since it was forgotten
    void forget() { runs = 0; }
  };

  State at = VectorXd::Constant(1, 200);
  Acceleration shared;
  std::vector<double> begun, predicted_at;  // where runs began; speeds of those that were predicted
  std::function<std::vector<State*>()> states;

  const State& state() const { return at; }
  Acceleration& acceleration() { return shared; }
  Motion run(double f) {
    begun.push_back(at[0]);
    ++shared.runs;
    at[0] = at[0] > 100 && f < kEnd ? f + 100 : 50;
    return {at[0]};
  }
  Motion run_from(const State& predicted, double f) {
    predicted_at.push_back(f);
    at = predicted;
    return run(f);
  }
  Motion follow(const State& predicted, const State& /*last*/, double f, const RmsRange& range) {
    CHECK(range.least < range.most);
    at = predicted;
    return run(f);
  }
  static State predicted(const std::vector<KnownOrbit<State>>& known, double f) {
    return whine::predicted(FlatStates{}, known, f);
  }
  static BranchMotion motion_at(double f, const Motion& motion) { return {f, motion.rms, 1}; }
  static BranchPoint point_at(double f, const Motion& motion) { return {f, motion.rms}; }
  static int single() { return 1; }
  static bool finds_jumps() { return true; }
  void watch(std::function<std::vector<State*>()> all) { states = std::move(all); }
};

std::vector<double> speeds() {
  std::vector<double> out;
  for (double f = 100; f <= 170; f += 5) out.push_back(f);
  return out;
}

}  // namespace

TEST_CASE(
    "a sweep goes on from where the motions of the last speeds lead, and after a jump from the last one") {
  TwoBranches rig;
  SpeedSweep<TwoBranches> sweep(rig, SteadyState::extrapolate);
  std::vector<double> rms;
  std::vector<std::string> notes;
  sweep.run(
      speeds(),
      [&](long, long total, const std::string& note) {
        CHECK(total == 15);
        notes.push_back(note);
      },
      [&](long i, TwoBranches::Motion&& motion) {
        CHECK(static_cast<size_t>(i) == rms.size());
        rms.push_back(motion.rms);
        return "a note";
      });
  REQUIRE(rms.size() == 15);
  CHECK(rms[7] == 235);
  CHECK(rms[8] == 50);  // 140 Hz
  CHECK(notes[1] == "100 Hz, a note");
  // From the third speed on the branch is known: runs begin on it.
  CHECK(rig.begun[2] == relative(210.0, 1e-12));
  CHECK(rig.begun[7] == relative(235.0, 1e-12));
  CHECK(rig.begun[9] == 50);  // not beyond the jump
  CHECK(rig.states().size() == 15);
  for (const double f : rig.predicted_at) CHECK(f != 145);
}

TEST_CASE("plain integration begins each speed with the last one's state") {
  TwoBranches rig;
  SpeedSweep<TwoBranches> sweep(rig, SteadyState::integrate);
  sweep.run(
      speeds(), [](auto&&...) {}, [](long, auto&&) { return ""; });
  CHECK(rig.predicted_at.empty());
  CHECK(rig.begun[3] == 210);
}

TEST_CASE("a jump of a sweep is enclosed at the end of its branch, to the width that is asked for") {
  for (const SteadyState method : {SteadyState::extrapolate, SteadyState::integrate})
    for (const double width : {0.0, 1e-3}) {
      TwoBranches rig;
      SpeedSweep<TwoBranches> sweep(rig, method);
      sweep.run(
          speeds(), [](auto&&...) {}, [](long, auto&&) { return ""; });
      std::vector<BranchPoint> early;
      const std::vector<BranchJump> jumps = sweep.jumps(width, &early, [](auto&&...) {});
      REQUIRE(jumps.size() == 1);
      CHECK(jumps[0].located);
      CHECK(std::abs(jumps[0].frequency - kEnd) <= jumps[0].width);
      CHECK(jumps[0].width <= (width > 0 ? width : 5.0 / 64));
    }
}
