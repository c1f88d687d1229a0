// A pair on candidate contact zones of growing levels, whose strips are of one width: a candidate zone holds those of the level
// below. A motion is that of the lowest level that holds it.
#pragma once
#include <memory>
#include <vector>

#include "dynamics/dynamics.h"
#include "results/static.h"
#include "system/rolling_mesh.h"

namespace whine {

// The zone of a level: 0 is what the statics' load asks for, each further one wider by kWidening, with strips as wide as those of
// level 0.
CandidateZone zone_of_level(const GearMeshModel& model, const StaticResult& statics, int level);
inline constexpr int kMostZoneLevel = 8;
// Throws ModelRangeError, with the speed (Hz), above kMostZoneLevel.
void require_zone_level(const GearMeshModel& model, const StaticResult& statics, int level,
                        double mesh_frequency);

class ZoneLevels {
 public:
  // steps: positions of a mesh period that every level has. model and statics stay where they are.
  ZoneLevels(const GearMeshModel& model, const DynamicParameters& parameters, const StaticResult& statics,
             int steps);

  // The pair on a level, built when it is first asked for. Errors of RollingDynamics::set_zone.
  RollingDynamics& at(int level);
  void require(int level, double mesh_frequency) const {
    require_zone_level(model_, statics_, level, mesh_frequency);
  }
  // Largest |pair| that any level built so far can touch.
  int reach() const { return reach_; }
  // Every mode of a mesh fills the memory once.
  bool keeps_one() const { return parameters_.fidelity.body == BodyModel::full; }
  // Mean over the mesh period with the contact frozen as the static load leaves it. Hz
  double natural_frequency();

 private:
  const GearMeshModel& model_;
  DynamicParameters parameters_;
  const StaticResult& statics_;
  int steps_ = 0, reach_ = 0;
  std::vector<std::unique_ptr<RollingDynamics>> levels_;
};

}  // namespace whine
