#include "dynamics/steady_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "base/error.h"
#include "base/progress.h"
#include "orbits/recurrence.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = RollingDynamics::State;

namespace {

constexpr int kMostPeriods = 3000;   // mesh periods per speed, before it counts as not periodic
constexpr int kLeastTurns = 100;     // but this many hunting periods
constexpr int kAndersonColumns = 2;  // as many multipliers go at once: the slowest two, of one resonance
constexpr double kClose = 1e-2;      // change per period below which the motion counts as close to its orbit
constexpr double kFarAlong = 2.5;    // of the last step along a branch: further it does not predict
constexpr int kLongestPause = 64;    // periods of plain integration after proposals that gained nothing

double oscillating_rms(const std::vector<RollingDynamics::Period>& record) {
  double sum = 0, square = 0;
  Eigen::Index count = 0;
  for (const auto& period : record) {
    sum += period.transmission_error.sum();
    count += period.transmission_error.size();
  }
  const double mean = sum / static_cast<double>(count);
  for (const auto& period : record) square += (period.transmission_error.array() - mean).square().sum();
  return std::sqrt(square / static_cast<double>(count));
}

// Sample 0 of an integration is that of the period after it, in the names of its teeth.
void begin_with_end_of(const RollingDynamics::Period& before, RollingDynamics::Period& period) {
  period.transmission_error[0] = before.transmission_error[0];
  if (before.tooth_pair_load.rows() == period.tooth_pair_load.rows())
    period.tooth_pair_load.col(0) = before.tooth_pair_load.col(0);
  for (size_t g = 0; g < period.bearing_force.size(); ++g)
    if (period.bearing_force[g].size() > 0) period.bearing_force[g].col(0) = before.bearing_force[g].col(0);
}

// Sum of weight times state. States of another range know more or fewer teeth than the last, or have other strips, whose
// forces are then those of the last; only an energy balance reads them.
State combination(const std::vector<const State*>& states, const VectorXd& weight) {
  const State& last = *states.back();
  State sum = last;
  const Eigen::Index n = weight.size();
  const auto add = [&](auto&& part) {
    auto& total = part(sum);
    total *= weight[n - 1];
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const auto& other = part(*states[i]);
      const Eigen::Index columns = std::min(total.cols(), other.cols());
      total.middleCols((total.cols() - columns) / 2, columns) +=
          weight[i] * other.middleCols((other.cols() - columns) / 2, columns);
    }
  };
  add([](auto& s) -> auto& { return s.z; });
  add([](auto& s) -> auto& { return s.v; });
  add([](auto& s) -> auto& { return s.force; });
  for (size_t g = 0; g < sum.relaxed.size(); ++g) {
    add([g](auto& s) -> auto& { return s.relaxed[g]; });
    add([g](auto& s) -> auto& { return s.load[g]; });
  }
  if (std::all_of(states.begin(), states.end(),
                  [&](const State* s) { return s->p.size() == last.p.size(); })) {
    add([](auto& s) -> auto& { return s.p; });
    add([](auto& s) -> auto& { return s.d; });
  }
  return sum;
}

}  // namespace

bool AndersonAcceleration::ready() const {
  return last_ && static_cast<int>(known_.size()) == kAndersonColumns;
}

void AndersonAcceleration::take(const RollingDynamics& dynamics, const State& start, const State& end) {
  const VectorXd change = dynamics.difference(end, start);
  in_a_row_ = last_ && dynamics.distance(start, last_->end) == 0 ? in_a_row_ + 1 : 1;
  if (last_) {
    known_.push_back({combination({&last_->end, &end}, Eigen::Vector2d(-1, 1)),
                      dynamics.difference(start, last_->start), change - last_->change});
    if (static_cast<int>(known_.size()) > kAndersonColumns) known_.pop_front();
  }
  last_ = {start, end, change};
}

std::optional<State> AndersonAcceleration::propose() const {
  constexpr double kAlike = 1e-3;  // columns of unit length that differ by less say nothing new
  // Turns in a row come to show the slowest multipliers; of others, some of them of another speed, one may seem to be smaller
  // than it is, by some hundredths.
  constexpr double kSurelyInside = 0.9;
  const double most = in_a_row_ > kAndersonColumns ? 1 : kSurelyInside;
  const int n = static_cast<int>(known_.size());
  MatrixXd start(last_->change.size(), n), change(last_->change.size(), n);
  VectorXd length(n);
  for (int i = 0; i < n; ++i) {
    length[i] = known_[i].change.norm();
    if (!(length[i] > 0)) return std::nullopt;
    start.col(i) = known_[i].start / length[i];
    change.col(i) = known_[i].change / length[i];
  }
  const MatrixXd map = MatrixXd::Identity(n, n) + least_squares(start, change, kAlike);
  const GeneralEigenvalues multipliers = general_eigenvalues(map);
  if (!multipliers.converged || !(multipliers.values.cwiseAbs().maxCoeff() < most)) return std::nullopt;
  VectorXd weight(n + 1);
  weight << -least_squares(change, last_->change, kAlike).cwiseQuotient(length), 1;
  std::vector<const State*> states;
  for (const AndersonColumn& column : known_) states.push_back(&column.end);
  states.push_back(&last_->end);
  return combination(states, weight);
}

// Orders of subharmonics are in hunting periods.
// NOLINTNEXTLINE(readability-function-size): one loop over mesh periods, whose parts share the proposal, the recurrence and the state
std::optional<Orbit> iterate_to_orbit(RollingDynamics& dynamics, State& state, double periodicity,
                                      SteadyState method, const RmsRange& looked_for,
                                      AndersonAcceleration* shared) {
  Orbit orbit;
  AndersonAcceleration own;
  AndersonAcceleration& acceleration = shared ? *shared : own;
  acceleration.interrupt();
  // The map whose orbits are looked for: a hunting period, which is a mesh period for teeth that are alike.
  const int hunting = dynamics.hunting_periods(), most = std::max(kMostPeriods / hunting, kLeastTurns);
  const bool watched = hunting == 1 && (looked_for.least > 0 || std::isfinite(looked_for.most));
  Recurrence<State> recurrence(periodicity, state);
  RollingDynamics::Period period;
  State start = state;  // of the last turn
  struct Proposal {
    State integrated;      // where integration had come to
    double change = 0;     // in its last period
    bool pending = false;  // the present state descends from it
  } proposal;
  bool proposed = false;  // the present state may descend from one, also where another one was rejected since
  int pause = 0, patience = 0;
  const auto integrate_on = [&] {
    pause = patience = std::min(2 * patience + kAndersonColumns, kLongestPause);
    acceleration.forget();
  };
  const auto reject = [&] {
    integrate_on();
    proposal.pending = false;
    state = proposal.integrated;
    recurrence.restart(state);
  };
  int turns = 0;
  const auto turn = [&] {
    start = state;
    ++turns;
    try {
      for (int k = 0; k < hunting; ++k) {
        report_step("mesh period", static_cast<long>(turns - 1) * hunting + k,
                    static_cast<long>(most) * hunting);
        if (!dynamics.integrate(state, period)) return false;
      }
    } catch (const Error& error) {  // a proposal may lie where no motion does
      if (!proposal.pending || error.kind() != Failure::numerical) throw;
      return false;
    }
    return true;
  };
  for (int n = 1;; ++n) {
    if (!turn()) {
      if (!proposal.pending) return std::nullopt;
      reject();
      continue;
    }
    if (watched) {
      const double rms = oscillating_rms({period});
      if (!(rms >= looked_for.least && rms <= looked_for.most)) {
        if (proposal.pending) {
          reject();
          continue;
        }
        orbit.multiple = 0;
        orbit.periods = n;
        orbit.rms = rms;
        orbit.record.assign(1, period);
        return orbit;
      }
    }
    recurrence.compare(state, n, [&](const State& a, const State& b) { return dynamics.distance(a, b); });
    const int multiple = recurrence.multiple();
    if (multiple > 0 || n >= most) {
      // Not periodic: reported as such, with the last periods as they are.
      const State reached = state;
      orbit.multiple = multiple * hunting;
      orbit.periods = n * hunting;
      orbit.residual = recurrence.change(std::max(multiple, 1));
      orbit.energy_balance = {};
      orbit.record.clear();
      const int recorded = hunting * (multiple > 0  ? multiple
                                      : hunting > 1 ? 1
                                                    : Recurrence<State>::kMostMultiple);
      RollingDynamics::Period before = period;
      for (int k = 0; k < recorded; ++k) {
        if (!dynamics.integrate(state, period, watched ? nullptr : &orbit.energy_balance))
          return std::nullopt;
        orbit.record.push_back(period);
        // An integration ends with the first sample of the period after it.
        if (recorded > 1) begin_with_end_of(before, orbit.record.back());
        before = period;
      }
      // A proposal may have hit an unstable orbit: then the period just recorded was a step away from it.
      const bool leaves =
          proposed && multiple == 1 && n < most && dynamics.distance(state, reached) > orbit.residual;
      if (!leaves) {
        orbit.rms = oscillating_rms(orbit.record);
        return orbit;
      }
      ++n;
      integrate_on();
    }
    recurrence.keep(state, n);

    if (method == SteadyState::integrate) continue;
    if (proposal.pending && recurrence.change(1) > proposal.change) {
      reject();
      continue;
    }
    if (pause > 0) {
      --pause;
      continue;
    }
    acceleration.take(dynamics, start, state);
    if (!acceleration.ready() || recurrence.change(1) >= kClose) continue;
    if (const auto predicted = acceleration.propose()) {
      proposal = {state, recurrence.change(1), true};
      proposed = true;
      state = *predicted;
      recurrence.restart(state);
    }
  }
}

State predicted(const RollingDynamics& dynamics, const std::vector<KnownOrbit>& branch,
                double mesh_frequency) {
  const size_t n = branch.size();
  const KnownOrbit& last = branch[n - 1];
  if (n < 2) return last.state;
  const KnownOrbit& before = branch[n - 2];
  const VectorXd step = dynamics.difference(last.state, before.state);
  const double length = step.norm(), ahead = mesh_frequency - last.mesh_frequency,
               run = last.mesh_frequency - before.mesh_frequency;
  if (!(length > 0)) return last.state;
  if (n > 2) {
    // Way along the branch, from the last orbit on, as its last step sees it.
    const KnownOrbit& first = branch[n - 3];
    const double s1 = -length, s0 = s1 - dynamics.difference(before.state, first.state).dot(step) / length,
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
        return combination({&first.state, &before.state, &last.state}, weight);
      }
    }
  }
  const double s = ahead / run;
  if (!(s > 0 && s < kFarAlong)) return last.state;
  return combination({&before.state, &last.state}, Eigen::Vector2d(-s, 1 + s));
}

}  // namespace whine
