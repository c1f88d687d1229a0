#include "studies/zone_levels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "system/system_statics.h"

namespace whine {

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

ZoneLevels::ZoneLevels(const GearMeshModel& model, const DynamicParameters& parameters,
                       const StaticResult& statics, int steps)
    : model_(model), parameters_(parameters), statics_(statics), steps_(steps) {}

void require_zone_level(const GearMeshModel& model, const StaticResult& statics, int level,
                        double mesh_frequency) {
  if (level <= kMostZoneLevel) return;
  const MotionBounds most(model, statics, std::pow(kWidening, kMostZoneLevel));
  fail_outside_range(Failure::numerical, "at ", mesh_frequency,
                     " Hz contact leaves the flanks: forces above ", most.force, " N or deflections above ",
                     most.deflection * 1e6, " micrometres; lower the torque");
}

double ZoneLevels::natural_frequency() {
  constexpr int kPhases = 32;
  const int positions = std::min(kPhases, steps_);
  double sum = 0;
  // Of teeth that differ other ones at each phase.
  for (int i = 0; i < positions; ++i)
    sum += at(0).frozen_frequency(i * steps_ / positions, i * at(0).hunting_periods() / positions);
  return sum / positions;
}

RollingDynamics& ZoneLevels::at(int level) {
  if (static_cast<int>(levels_.size()) <= level) levels_.resize(level + 1);
  if (!levels_[level]) {
    if (keeps_one())
      for (auto& other : levels_) other.reset();
    ZoneMemory fixed;
    for (const auto& other : levels_)
      if (other) {
        fixed.coordinates += other->memory().coordinates;
        fixed.gaps += other->memory().gaps;
      }
    levels_[level] = std::make_unique<RollingDynamics>(model_, parameters_);
    levels_[level]->set_zone(zone_of_level(model_, statics_, level), steps_, fixed);
    levels_[level]->rest();  // sets the scale of distances
    reach_ = std::max(reach_, levels_[level]->reach());
  }
  return *levels_[level];
}

}  // namespace whine
