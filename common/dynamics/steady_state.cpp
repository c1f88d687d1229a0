#include "dynamics/steady_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/progress.h"
#include "orbits/recurrence.h"
#include "signal/rms.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = RollingDynamics::State;

namespace {

constexpr int kMostPeriods = 3000;  // mesh periods per speed, before it counts as not periodic
constexpr int kLeastTurns = 100;    // but this many hunting periods

double rms_of(const std::vector<RollingDynamics::Period>& record) {
  std::vector<Eigen::Ref<const VectorXd>> parts;
  parts.reserve(record.size());
  for (const auto& period : record) parts.emplace_back(period.transmission_error);
  return oscillating_rms(parts);
}

// Sample 0 of an integration is that of the period after it, in the names of its teeth.
void begin_with_end_of(const RollingDynamics::Period& before, RollingDynamics::Period& period) {
  period.transmission_error[0] = before.transmission_error[0];
  if (before.tooth_pair_load.rows() == period.tooth_pair_load.rows())
    period.tooth_pair_load.col(0) = before.tooth_pair_load.col(0);
  for (size_t g = 0; g < period.bearing_force.size(); ++g)
    if (period.bearing_force[g].size() > 0) period.bearing_force[g].col(0) = before.bearing_force[g].col(0);
}

}  // namespace

State RollingStates::combination(const std::vector<const State*>& states, const VectorXd& weight) {
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

namespace {

// Turns are hunting periods, which are mesh periods for teeth that are alike.
class RollingOrbit : public RollingStates {
 public:
  RollingOrbit(RollingDynamics& dynamics, const RmsRange& looked_for, int most_turns)
      : RollingStates{dynamics},
        looked_for_(looked_for),
        hunting_(dynamics.hunting_periods()),
        most_(most_turns),
        watched_(hunting_ == 1 && (looked_for.least > 0 || std::isfinite(looked_for.most))) {}
  Orbit orbit;

  bool turn(State& state, int number) {
    wanted_ = true;
    for (int k = 0; k < hunting_; ++k) {
      report_step("mesh period", static_cast<long>(number) * hunting_ + k,
                  static_cast<long>(most_) * hunting_);
      if (!dynamics.integrate(state, period_)) return false;
    }
    if (!watched_) return true;
    const double rms = rms_of({period_});
    wanted_ = rms >= looked_for_.least && rms <= looked_for_.most;
    if (!wanted_) {
      orbit.rms = rms;
      orbit.record.assign(1, period_);
    }
    return true;
  }
  bool wanted() const { return wanted_; }
  // Of a motion that is not periodic the last periods as they are.
  bool record(State& state, const Repetition& found, bool /*confirm*/) {
    orbit.energy_balance = {};
    orbit.record.clear();
    const int recorded = hunting_ * (found.multiple > 0 ? found.multiple
                                     : hunting_ > 1     ? 1
                                                        : Recurrence<State>::kMostMultiple);
    RollingDynamics::Period before = period_;
    for (int k = 0; k < recorded; ++k) {
      if (!dynamics.integrate(state, period_, watched_ ? nullptr : &orbit.energy_balance)) return false;
      orbit.record.push_back(period_);
      // An integration ends with the first sample of the period after it.
      if (recorded > 1) begin_with_end_of(before, orbit.record.back());
      before = period_;
    }
    orbit.rms = rms_of(orbit.record);
    return true;
  }

 private:
  const RmsRange looked_for_;
  const int hunting_, most_;
  const bool watched_;
  bool wanted_ = true;
  RollingDynamics::Period period_;
};

}  // namespace

std::optional<Orbit> iterate_to_orbit(RollingDynamics& dynamics, State& state, double periodicity,
                                      SteadyState method, const RmsRange& looked_for,
                                      RollingAcceleration* shared) {
  const int hunting = dynamics.hunting_periods(), most = std::max(kMostPeriods / hunting, kLeastTurns);
  RollingOrbit motion(dynamics, looked_for, most);
  RollingAcceleration own;
  const auto found =
      iterate(motion, state, {periodicity, most, method == SteadyState::extrapolate}, shared ? *shared : own);
  if (!found) return std::nullopt;
  // Orders of subharmonics are in hunting periods.
  motion.orbit.multiple = found->multiple * hunting;
  motion.orbit.periods = found->turns * hunting;
  motion.orbit.residual = found->residual;
  return std::move(motion.orbit);
}

}  // namespace whine
