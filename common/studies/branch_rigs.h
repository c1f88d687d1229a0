// What a follower of branches has to know of a pair, and of a train, in motion.
//
// A rig has a period Map and States between which it goes: one that a map of it is at, also after it was made anew with more contacts.
#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dynamics/period_map.h"
#include "dynamics/system_period_map.h"
#include "model/stages.h"
#include "orbits/periodic_motion.h"
#include "studies/train_in_motion.h"
#include "studies/zone_levels.h"

namespace whine {

// What a motion settles into.
struct Settled {
  int multiple =
      1;  // turns, which are mesh periods of teeth that are alike, after which it repeats; 0: it does not
  int turns = 0;        // that were integrated
  double residual = 0;  // change of the state over them, relative
};

// A pair on candidate contact zones that grow.
class PairRig {
 public:
  using Map = RollingPeriodMap;
  using State = RollingDynamics::State;
  // All must live as long as this; nobody else may use the dynamics meanwhile.
  PairRig(RollingDynamics& dynamics, const GearMeshModel& model, const StaticResult& statics,
          const SweepParameters& settings);
  void begin();  // on the smallest zone
  State rest() { return dynamics_.rest(); }
  std::unique_ptr<Map> map(int steps) { return std::make_unique<Map>(dynamics_, steps); }
  // From a state until the motion repeats. Nothing if contact leaves the zone; the state is then undefined.
  std::optional<Settled> settle(State& state, double mesh_frequency, int steps, SteadyState method);
  // The next zone. states: fit it then. Throws ModelRangeError above kMostZoneLevel.
  void widen(const std::vector<State*>& states);
  // Contact forces where this zone has its strips: an orbit puts them there in the periods after which it repeats, at the map's
  // speed. False if contact leaves the zone.
  bool fit(State& state, int periods);
  // Of a contact of a map's events: its mesh, from 0, and its tooth pair.
  static std::pair<int, int> place_of(int contact) { return {0, contact}; }
  int level() const { return level_; }

 private:
  RollingDynamics& dynamics_;
  const GearMeshModel& model_;
  const StaticResult& statics_;
  const SweepParameters& settings_;
  int finest_, level_ = -1;
};

// A train with the tip edges that are looked at.
class TrainRig {
 public:
  using Map = SystemPeriodMap;
  using State = SystemDynamics::State;
  TrainRig(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies);
  TrainInMotion& train() { return train_; }
  const TrainInMotion& train() const { return train_; }
  void begin() {}
  State rest() { return train_.dynamics().rest(); }
  std::unique_ptr<Map> map(int steps) { return std::make_unique<Map>(train_.dynamics(), steps); }
  // shared: as iterate_to_orbit() takes it, of this train since it was widened last.
  std::optional<Settled> settle(State& state, double mesh_frequency, int steps, SteadyState method,
                                AndersonAcceleration<FlatStates>* shared = nullptr);
  // The state to start from so as to stay on the branch of these orbits, see predicted().
  State predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency, int steps);
  void widen(const std::vector<State*>& states) { train_.widen(states); }
  bool fit(State& /*state*/, int /*periods*/) { return true; }
  std::pair<int, int> place_of(int slot) {
    const SystemDynamics& dynamics = train_.dynamics();
    const int tooth = slot / dynamics.points();
    return {tooth / dynamics.tooth_pairs(), tooth % dynamics.tooth_pairs() + dynamics.first_pair()};
  }

 private:
  const SystemSweepParameters& settings_;
  TrainInMotion train_;
};

}  // namespace whine
