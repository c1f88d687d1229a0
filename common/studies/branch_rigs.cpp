#include "studies/branch_rigs.h"

#include <algorithm>
#include <cmath>

#include "base/model_range.h"
#include "dynamics/steady_state.h"
#include "orbits/periodic_motion.h"
#include "studies/sweep.h"

namespace whine {

PairRig::PairRig(RollingDynamics& dynamics, const GearMeshModel& model, const StaticResult& statics,
                 const SweepParameters& settings)
    : dynamics_(dynamics),
      model_(model),
      statics_(statics),
      settings_(settings),
      finest_(steps_at(settings.time, settings.frequency_from)) {}

void PairRig::begin() {
  level_ = -1;
  widen({});
}

void PairRig::widen(const std::vector<State*>& /*states*/) {
  if (++level_ > kMostZoneLevel)
    fail_outside_range(Failure::numerical, "contact leaves the flanks: forces above ",
                       MotionBounds(model_, statics_, std::pow(kWidening, kMostZoneLevel)).force,
                       " N; lower the torque");
  dynamics_.set_zone(zone_of_level(model_, statics_, level_), finest_);
}

std::optional<Settled> PairRig::settle(State& state, double mesh_frequency, int steps, SteadyState method) {
  dynamics_.set_speed(mesh_frequency, steps);
  const auto orbit = iterate_to_orbit(dynamics_, state, settings_.time.periodicity, method);
  if (!orbit) return std::nullopt;
  return Settled{orbit->multiple, orbit->periods, orbit->residual};
}

bool PairRig::fit(State& state, int periods) {
  RollingDynamics::Period period;
  for (int k = 0; k < periods; ++k)
    if (!dynamics_.integrate(state, period)) return false;
  return true;
}

TrainRig::TrainRig(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies)
    : settings_(settings), train_(settings, bodies, steps_at(settings.time, settings.frequency_from)) {}

std::optional<Settled> TrainRig::settle(State& state, double mesh_frequency, int steps, SteadyState method,
                                        AndersonAcceleration<FlatStates>* shared) {
  const int hunting = train_.dynamics().hunting_periods();
  SystemPeriodMap map(train_.dynamics(), steps);
  map.set_parameter(mesh_frequency);
  try {
    const PeriodicMotion motion = iterate_to_orbit(
        map, map.flat(state),
        {settings_.time.periodicity, std::max(kMostSystemPeriods / hunting, kLeastSystemTurns),
         method == SteadyState::extrapolate},
        shared);
    state = map.state(motion.state);
    return Settled{motion.multiple, motion.turns, motion.residual};
  } catch (const ModelRangeError&) {
    // Of a proposal that was rejected before nothing is thrown: this is of the period integrated last.
    if (!map.left_last()) throw;
    return std::nullopt;
  }
}

TrainRig::State TrainRig::predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency,
                                    int steps) {
  const SystemPeriodMap map(train_.dynamics(), steps);
  std::vector<KnownOrbit<Eigen::VectorXd>> flat;
  flat.reserve(branch.size());
  for (const KnownOrbit<State>& orbit : branch) flat.push_back({orbit.mesh_frequency, map.flat(orbit.state)});
  return map.state(whine::predicted(FlatStates{}, flat, mesh_frequency));
}

}  // namespace whine
