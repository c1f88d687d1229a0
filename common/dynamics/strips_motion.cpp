#include "dynamics/strips_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "dynamics/period_map.h"
#include "system/system_statics.h"

namespace whine {

using PairState = RollingDynamics::State;

CandidateZone zone_of_level(const GearMeshModel& model, const StaticResult& statics, int level) {
  const auto at = [&](int l) {
    return candidate_zone(model, statics, MotionBounds(model, statics, std::pow(kWidening, l)));
  };
  CandidateZone range = at(level);
  if (level == 0) return range;
  // Strips as wide as those of the narrowest zone.
  const CandidateZone lowest = at(0);
  range.strips = padded(static_cast<int>(std::ceil(range.half_zone / lowest.half_zone * lowest.strips)));
  range.half_zone = lowest.half_zone * range.strips / lowest.strips;
  return range;
}

StripsMotion::StripsMotion(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                           const DynamicParameters& parameters, int positions)
    : system_(driver, driven, statics.mesh),
      statics_(statics),
      parameters_(parameters),
      positions_(positions),
      hunting_(whine::hunting_periods(system_)) {}

double StripsMotion::natural_frequency() {
  constexpr int kPhases = 32;
  const int phases = std::min(kPhases, positions_);
  double sum = 0;
  // Of teeth that differ other ones at each phase.
  for (int i = 0; i < phases; ++i)
    sum += at(0).frozen_frequency(i * positions_ / phases, i * hunting_ / phases);
  return sum / phases;
}

RollingDynamics& StripsMotion::at(int level) {
  if (static_cast<int>(levels_.size()) <= level) levels_.resize(static_cast<size_t>(level) + 1);
  auto& own = levels_[static_cast<size_t>(level)];
  if (!own) {
    if (keeps_one())
      for (auto& other : levels_) other.reset();
    ZoneMemory fixed;
    for (const auto& other : levels_)
      if (other) {
        fixed.coordinates += other->memory().coordinates;
        fixed.gaps += other->memory().gaps;
      }
    own = std::make_unique<RollingDynamics>(model(), parameters_);
    own->set_zone(zone_of_level(model(), statics_, level), positions_, fixed);
    own->rest();  // sets the scale of distances
    reach_ = std::max(reach_, own->reach());
  }
  return *own;
}

std::optional<MotionRecord> StripsMotion::settle(State& state, double mesh_frequency, int steps,
                                                 const Settling& how, MotionAcceleration* shared) {
  RollingDynamics& dynamics = this->dynamics();
  dynamics.set_speed(mesh_frequency, steps);
  const auto orbit = iterate_to_orbit(dynamics, std::get<PairState>(state), how.periodicity, how.method,
                                      how.looked_for, shared ? &shared->strips : nullptr);
  if (!orbit) return std::nullopt;
  MotionRecord out{orbit->multiple, orbit->periods, orbit->residual, orbit->rms, {}, {}, {}, 0, {}};
  out.record.resize(orbit->record.size());
  for (size_t k = 0; k < out.record.size(); ++k) orbit->record[k].show(out.record[k]);
  out.energy = orbit->energy_balance;
  if (model().friction.acts()) {
    out.coefficient.setConstant(1, dynamics.friction());
    const double turning =
        2 * std::numbers::pi * mesh_frequency / model().kinematics.gear(0).design().teeth;  // rad s-1
    out.power_in = parameters_.torque * turning;
  }
  return out;
}

MotionState StripsMotion::predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency,
                                    int /*steps*/) {
  std::vector<KnownOrbit<PairState>> own;
  own.reserve(branch.size());
  for (const KnownOrbit<State>& orbit : branch)
    own.push_back({orbit.mesh_frequency, std::get<PairState>(orbit.state)});
  return whine::predicted(RollingStates{dynamics()}, own, mesh_frequency);
}

bool StripsMotion::integrate(State& state, MotionPeriod& period) {
  if (!dynamics().integrate(std::get<PairState>(state), period_)) return false;
  period_.show(period);
  return true;
}

std::unique_ptr<MotionMap> StripsMotion::map(int steps) {
  return std::make_unique<RollingPeriodMap>(dynamics(), steps);
}

void StripsMotion::widen(const std::vector<State*>& /*states*/) {
  if (level_ < kMostZoneLevel) {
    ++level_;
    return;
  }
  const MotionBounds most(model(), statics_, std::pow(kWidening, kMostZoneLevel));
  fail_outside_range(Failure::numerical, "contact leaves the flanks: forces above ", most.force,
                     " N or deflections above ", most.deflection * 1e6, " micrometres; lower the torque");
}

bool StripsMotion::narrow() {
  if (level_ == 0 || keeps_one()) return false;
  --level_;
  return true;
}

bool StripsMotion::fit(State& state, int periods) {
  for (int k = 0; k < periods; ++k)
    if (!dynamics().integrate(std::get<PairState>(state), period_)) return false;
  return true;
}

}  // namespace whine
