// A pair in motion on candidate contact zones of growing levels, whose strips are of one width: a candidate zone holds those of the level
// below. A motion is that of the lowest level that holds it.
#pragma once
#include <memory>
#include <vector>

#include "dynamics/motion.h"
#include "results/static.h"
#include "system/rolling_mesh.h"

namespace whine {

// The zone of a level: 0 is what the statics' load asks for, each further one wider by kWidening, with strips as wide as those of
// level 0.
CandidateZone zone_of_level(const GearMeshModel& model, const StaticResult& statics, int level);
inline constexpr int kMostZoneLevel = 8;

class StripsMotion : public Motion {
 public:
  // positions: of a mesh period that every level has; statics stays where it is.
  StripsMotion(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
               const DynamicParameters& parameters, int positions);

  const SystemModel& system() const override { return system_; }
  const GearMeshModel& model() const { return system_.mesh[0]; }
  const StaticResult& statics() const { return statics_; }
  int hunting_periods() const override { return hunting_; }
  double natural_frequency() override;
  double axis_damper(int g) override { return at(0).bearing_damper(g); }
  // The pair on the present level, and on one that is built when it is first asked for. Errors of RollingDynamics::set_zone.
  RollingDynamics& dynamics() { return at(level_); }
  RollingDynamics& at(int level);
  int reach() const override { return reach_; }

  State rest() override { return dynamics().rest(); }
  std::optional<MotionRecord> settle(State& state, double mesh_frequency, int steps, const Settling& how,
                                     MotionAcceleration* shared = nullptr) override;
  State predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency, int steps) override;
  void pass_speed(double mesh_frequency, int steps) override { dynamics().pass_speed(mesh_frequency, steps); }
  bool integrate(State& state, MotionPeriod& period) override;
  std::unique_ptr<MotionMap> map(int steps) override;
  void widen(const std::vector<State*>& states) override;  // states fit every level
  bool narrow() override;
  int level() const override { return level_; }
  int most_level() const override { return kMostZoneLevel; }
  void restore(int level) override { level_ = level; }
  bool fit(State& state, int periods) override;

 private:
  // Every mode of a mesh fills the memory once.
  bool keeps_one() const { return parameters_.fidelity.body == BodyModel::full; }

  const SystemModel system_;
  const StaticResult& statics_;
  DynamicParameters parameters_;
  int positions_ = 0, reach_ = 0, level_ = 0, hunting_ = 1;
  std::vector<std::unique_ptr<RollingDynamics>> levels_;
  RollingDynamics::Period period_;
};

}  // namespace whine
