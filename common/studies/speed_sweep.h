// A rig from speed to speed, and where the RMS of its motions jumps: one sweep for pairs and trains.
//
// Each speed starts from where the motions of the last speeds lead, which is nearer to the motion there than where the last one
// ended. Where the RMS steps, the branch is followed with smaller steps to its end. A rig has
//   State, Motion       where a run begins and ends; what it settled into
//   Acceleration        what the runs of one speed show for the next, with forget()
//   state(), acceleration()   those of its next run
//   run(f)              the motion from state(), at a mesh frequency (Hz)
//   run_from(s, f)      the same from a state that is predicted; from state() if that leads beyond what the contact holds
//   follow(s, last, f, range)   the same along a branch, `last` on it; one whose RMS leaves the range (m) may be given up
//   predicted(known, f) the state to start from so as to stay on the branch of these orbits, see predicted() of orbits/iteration.h
//   motion_at(f, motion), point_at(f, motion)   RMS and period of a motion; what a map of jumps takes of it
//   single()            mesh periods of a motion that is not subharmonic
//   finds_jumps()       whether a step of the RMS is followed
//   watch(states)       gives all states that are kept: a rig that is made anew with more contacts has to fit them
#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "dynamics/steady_state.h"
#include "model/scene.h"
#include "orbits/iteration.h"
#include "signal/jumps.h"

namespace whine {

template <class Rig>
class SpeedSweep {
 public:
  using State = typename Rig::State;
  using Motion = typename Rig::Motion;
  using Report = std::function<void(long, long, const std::string&)>;

  SpeedSweep(Rig& rig, SteadyState method) : rig_(rig), leads_(method == SteadyState::extrapolate) {
    rig_.watch([this] { return states(); });
  }

  // Through the speeds (Hz). take(i, motion): of speed i, gives a note. report(done, total, note) is called before and after each.
  template <class Take>
  void run(const std::vector<double>& speeds, const Report& report, const Take& take) {
    const auto total = static_cast<long>(speeds.size());
    for (long i = 0; i < total; ++i) {
      const double f = speeds[static_cast<size_t>(i)];
      report(i, total, text(f, " Hz"));
      Motion motion = leads_ ? run_on(f) : rig_.run(f);
      motions_.push_back(rig_.motion_at(f, motion));
      reached_.push_back(rig_.state());
      report(i + 1, total, text(f, " Hz, ", take(i, std::move(motion))));
    }
  }

  // Where the RMS steps along the speeds. width: Hz, jumps are enclosed to that or less; 0: to 1/64 of the step of the speeds.
  // left_early: as find_jump() takes it.
  std::vector<BranchJump> jumps(double width, std::vector<BranchPoint>* left_early, const Report& report) {
    std::vector<BranchJump> out;
    const auto total = static_cast<long>(motions_.size());
    for (size_t i = 1; rig_.finds_jumps() && i < motions_.size(); ++i) {
      if (!may_break(motions_, i)) continue;
      report(total, total,
             text("what lies between ", motions_[i - 1].mesh_frequency, " and ", motions_[i].mesh_frequency,
                  " Hz"));
      const auto follower = [&] {
        BranchContinuation follow = continuation(i);
        follow.finest = width;
        return follow;
      };
      if (const auto jump = find_jump(motions_, i, follower, left_early)) out.push_back(*jump);
    }
    return out;
  }

 private:
  static constexpr size_t kMostKnown = 3;  // orbits that say where a branch leads
  using Known = KnownOrbit<State>;
  struct Run {
    Motion motion;
    Known end;
    typename Rig::Acceleration acceleration;
  };
  struct Branch {  // that is followed
    std::vector<Run> runs;
    std::vector<Known> known;
    typename Rig::Acceleration acceleration;
    double rms = 0;
    bool single = false;
  };

  std::vector<State*> states() {
    std::vector<State*> out;
    out.reserve(reached_.size() + branch_.known.size() + branch_.runs.size());
    for (State& state : reached_) out.push_back(&state);
    for (Known& orbit : branch_.known) out.push_back(&orbit.state);
    for (Run& run : branch_.runs) out.push_back(&run.end.state);
    return out;
  }

  // From where the last one ended where the RMS does not go on evenly (by more than some 8 % a step, or as across a jump).
  Motion run_on(double f) {
    const size_t n = motions_.size();
    const auto even = [&](size_t i) {
      return motions_[i - 1].multiple == rig_.single() && motions_[i].multiple == rig_.single() &&
             !may_break(motions_, i);
    };
    size_t first = n;
    while (first > 1 && n - first < kMostKnown - 1 && even(first - 1)) --first;
    if (first == n) {
      rig_.acceleration().forget();
      return rig_.run(f);
    }
    std::vector<Known> known;
    known.reserve(n - first + 1);
    for (size_t i = first - 1; i < n; ++i) known.push_back({motions_[i].mesh_frequency, reached_[i]});
    return rig_.run_from(rig_.predicted(known, f), f);
  }

  // How the branch of the motion i - 1 is followed.
  BranchContinuation continuation(size_t i) {
    const BranchMotion& from = motions_[i - 1];
    branch_ = {};
    branch_.rms = from.rms;
    // Of a subharmonic nothing says in which of its periods a run ends.
    branch_.single = from.multiple == rig_.single();
    size_t first = i - 1;
    while (branch_.single && first > 0 && i - first < kMostKnown &&
           motions_[first - 1].multiple == from.multiple)
      --first;
    for (size_t k = first; k < i; ++k) branch_.known.push_back({motions_[k].mesh_frequency, reached_[k]});
    BranchContinuation follower;
    follower.run = [this](double f, double most) {
      rig_.acceleration() = branch_.acceleration;
      const State& last = branch_.known.back().state;
      Motion motion =
          rig_.follow(leads_ ? rig_.predicted(branch_.known, f) : last, last, f,
                      branch_.single ? RmsRange{branch_.rms / most, branch_.rms * most} : RmsRange{});
      const BranchMotion out = rig_.motion_at(f, motion);
      branch_.runs.push_back({std::move(motion), {f, rig_.state()}, rig_.acceleration()});
      return out;
    };
    follower.keep = [this](int n) {
      const Run& run = branch_.runs[static_cast<size_t>(n)];
      branch_.known.push_back(run.end);
      branch_.acceleration = run.acceleration;
      if (!branch_.single || branch_.known.size() > kMostKnown) branch_.known.erase(branch_.known.begin());
      branch_.rms = rig_.motion_at(run.end.mesh_frequency, run.motion).rms;
      return rig_.point_at(run.end.mesh_frequency, run.motion);
    };
    return follower;
  }

  Rig& rig_;
  bool leads_;
  std::vector<BranchMotion> motions_;  // of the speeds
  std::vector<State> reached_;         // [motion]
  Branch branch_;
};

}  // namespace whine
