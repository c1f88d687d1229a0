// The stable periodic motion that integration settles into, of any model whose states can be told apart and combined.
//
// Period by period until the state repeats. Close to a periodic motion Anderson's method (Fang and Saad, Numer. Linear Algebra
// Appl. 16 (2009) 197, type II) takes out as many slow multipliers as it has columns. It is used only where the multipliers that
// its columns show lie inside the unit circle, and a proposal counts only if integrating on comes closer still; after one, a state
// that repeats is periodic only if the next period brings it closer: an unstable motion that was hit is left again.
//
// `States` have
//   State, kColumns                            what it goes on from; columns of Anderson's method
//   VectorXd difference(State a, State b)      a - b in the units of distance()
//   double distance(State a, State b)
//   State combination(vector<const State*>, VectorXd weights)
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "orbits/recurrence.h"

namespace whine {

// How the change of a state in a turn depends on the state, as the last turns have shown it: of neighbouring speeds nearly
// the same, so a speed begins with what the one before it has shown.
template <class States>
class AndersonAcceleration {
 public:
  using State = typename States::State;
  void forget() { *this = {}; }
  // What comes is of another speed, or does not go on from what was taken last.
  void interrupt() { last_.reset(); }
  void take(const States& space, const State& start, const State& end) {
    const Eigen::VectorXd change = space.difference(end, start);
    in_a_row_ = last_ && space.distance(start, last_->end) == 0 ? in_a_row_ + 1 : 1;
    if (last_) {
      known_.push_back({space.combination({&last_->end, &end}, Eigen::Vector2d(-1, 1)),
                        space.difference(start, last_->start), change - last_->change});
      if (static_cast<int>(known_.size()) > States::kColumns) known_.pop_front();
    }
    last_ = {start, end, change};
  }
  bool ready() const { return last_ && static_cast<int>(known_.size()) == States::kColumns; }
  // Where the change vanishes, as far as the columns see it. Nothing if a multiplier that they show is not inside the unit
  // circle: what lies there is no orbit that integration could find.
  std::optional<State> propose(const States& space) const {
    constexpr double kAlike = 1e-3;  // columns of unit length that differ by less say nothing new
    // Turns in a row come to show the slowest multipliers; of others, some of them of another speed, one may seem to be smaller
    // than it is, by some hundredths.
    constexpr double kSurelyInside = 0.9;
    const double most = in_a_row_ > States::kColumns ? 1 : kSurelyInside;
    const int n = static_cast<int>(known_.size());
    Eigen::MatrixXd start(last_->change.size(), n), change(last_->change.size(), n);
    Eigen::VectorXd length(n);
    for (int i = 0; i < n; ++i) {
      length[i] = known_[i].change.norm();
      if (!(length[i] > 0)) return std::nullopt;
      start.col(i) = known_[i].start / length[i];
      change.col(i) = known_[i].change / length[i];
    }
    const Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n) + least_squares(start, change, kAlike);
    const GeneralEigenvalues multipliers = general_eigenvalues(map);
    if (!multipliers.converged || !(multipliers.values.cwiseAbs().maxCoeff() < most)) return std::nullopt;
    Eigen::VectorXd weight(n + 1);
    weight << -least_squares(change, last_->change, kAlike).cwiseQuotient(length), 1;
    std::vector<const State*> states;
    for (const Column& column : known_) states.push_back(&column.end);
    states.push_back(&last_->end);
    return space.combination(states, weight);
  }

 private:
  struct Turn {
    State start, end;
    Eigen::VectorXd change;
  };
  struct Column {  // differences of two turns
    State end;
    Eigen::VectorXd start, change;
  };
  std::optional<Turn> last_;
  int in_a_row_ = 0;  // turns, each from where the one before it ended
  std::deque<Column> known_;
};

struct Iteration {
  double periodicity = 1e-5;  // distance of states at which they repeat
  int most_turns = 3000;      // after which the motion counts as not periodic
  bool accelerate = true;
};

struct Repetition {
  int multiple = 0;     // turns after which the state repeats; 0: it does not
  int turns = 0;        // that were made
  double residual = 0;  // distance over `multiple` turns
};

// Turns from `state` until it repeats. `Motion` are States that also have
//   bool turn(State& state, int number)     one turn; false: the model's range is left
//   bool wanted()                           false: this is not the motion that is looked for, and it is given up
//   bool record(State& state, const Repetition& found, bool confirm)   goes on over the motion that was found, by a turn at
//                                           least where its neighbour has to be known; false: the range is left
// Nothing if the range is left; the state is then undefined. Throws what turn() throws, but for proposals.
template <class Motion, class States>
std::optional<Repetition> iterate(Motion& motion, typename States::State& state, const Iteration& options,
                                  AndersonAcceleration<States>& acceleration) {
  using State = typename States::State;
  constexpr double kClose = 1e-2;    // change per turn below which the motion counts as close to its orbit
  constexpr int kLongestPause = 64;  // turns of plain integration after proposals that gained nothing
  acceleration.interrupt();
  Recurrence<State> recurrence(options.periodicity, state);
  const auto distance = [&](const State& a, const State& b) { return motion.distance(a, b); };
  State start = state;  // of the last turn
  struct Proposal {
    State integrated;      // where integration had come to
    double change = 0;     // in its last turn
    bool pending = false;  // the present state descends from it
  } proposal;
  bool proposed = false;  // the present state may descend from one, also where another one was rejected since
  int pause = 0, patience = 0, turns = 0;
  const auto integrate_on = [&] {
    pause = patience = std::min(2 * patience + States::kColumns, kLongestPause);
    acceleration.forget();
  };
  const auto reject = [&] {
    integrate_on();
    proposal.pending = false;
    state = proposal.integrated;
    recurrence.restart(state);
  };
  const auto turn = [&] {
    start = state;
    try {
      return motion.turn(state, turns++);
    } catch (const Error& error) {  // a proposal may lie where no motion does
      if (!proposal.pending || error.kind() != Failure::numerical) throw;
      return false;
    }
  };
  for (int n = 1;; ++n) {
    if (!turn() || !motion.wanted()) {
      if (proposal.pending) {
        reject();
        continue;
      }
      if (motion.wanted()) return std::nullopt;
      return Repetition{0, n, 0};
    }
    recurrence.compare(state, n, distance);
    if (const int multiple = recurrence.multiple(); multiple > 0 || n >= options.most_turns) {
      const State reached = state;
      const Repetition found{multiple, n, recurrence.change(std::max(multiple, 1))};
      // A proposal may have hit an unstable orbit: then the turn after it is a step away from it.
      const bool confirm = proposed && multiple == 1 && n < options.most_turns;
      if (!motion.record(state, found, confirm)) return std::nullopt;
      if (!confirm || !(motion.distance(state, reached) > found.residual)) return found;
      ++n;
      integrate_on();
    }
    recurrence.keep(state, n);

    if (!options.accelerate) continue;
    if (proposal.pending && recurrence.change(1) > proposal.change) {
      reject();
      continue;
    }
    if (pause > 0) {
      --pause;
      continue;
    }
    acceleration.take(motion, start, state);
    if (!acceleration.ready() || recurrence.change(1) >= kClose) continue;
    if (auto predicted = acceleration.propose(motion)) {
      proposal = {state, recurrence.change(1), true};
      proposed = true;
      state = std::move(*predicted);
      recurrence.restart(state);
    }
  }
}

// A state on a periodic orbit at a speed.
template <class State>
struct KnownOrbit {
  double mesh_frequency = 0;  // Hz
  State state;
};

// The state to start from at a mesh frequency (Hz) so as to stay on the branch of up to three orbits, the last one nearest:
// state and speed as quadratics of the way along the branch, which a fold does not stop. The last orbit's own state where
// they do not reach that far.
template <class States>
typename States::State predicted(const States& space,
                                 const std::vector<KnownOrbit<typename States::State>>& branch,
                                 double mesh_frequency) {
  using Eigen::VectorXd;
  using Known = KnownOrbit<typename States::State>;
  constexpr double kFarAlong = 2.5;  // of the last step along a branch: further it does not predict
  const size_t n = branch.size();
  const Known& last = branch[n - 1];
  if (n < 2) return last.state;
  const Known& before = branch[n - 2];
  const VectorXd step = space.difference(last.state, before.state);
  const double length = step.norm(), ahead = mesh_frequency - last.mesh_frequency,
               run = last.mesh_frequency - before.mesh_frequency;
  if (!(length > 0)) return last.state;
  if (n > 2) {
    // Way along the branch, from the last orbit on, as its last step sees it.
    const Known& first = branch[n - 3];
    const double s1 = -length, s0 = s1 - space.difference(before.state, first.state).dot(step) / length,
                 rate = run / length, earlier = (before.mesh_frequency - first.mesh_frequency) / (s1 - s0),
                 bend = (rate - earlier) / -s0, slope = rate - bend * s1;
    if (s0 < s1 && slope * ahead > 0) {
      const double inside = slope * slope + 4 * bend * ahead;
      // At the fold where the speed lies beyond it.
      const double s =
          inside > 0 ? 2 * ahead / (slope + std::copysign(std::sqrt(inside), slope)) : -slope / (2 * bend);
      if (s > 0 && s < kFarAlong * length) {
        VectorXd weight(3);
        weight << s * (s - s1) / (s0 * (s0 - s1)), s * (s - s0) / (s1 * (s1 - s0)),
            (s - s0) * (s - s1) / (s0 * s1);
        return space.combination({&first.state, &before.state, &last.state}, weight);
      }
    }
  }
  const double s = ahead / run;
  if (!(s > 0 && s < kFarAlong)) return last.state;
  return space.combination({&before.state, &last.state}, Eigen::Vector2d(-s, 1 + s));
}

}  // namespace whine
