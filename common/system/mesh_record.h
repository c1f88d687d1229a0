// What one mesh of a system at rest does, position after position, and what follows from it over the period: stiffness, tooth
// loads, load over the face, root stress, losses, parts of the compliance, flank pressure. Alike for the mesh of a pair and for each of a train.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "results/static.h"
#include "system/face_record.h"
#include "system/system_statics.h"

namespace whine {

class MeshRecord {
 public:
  // Of mesh m of a system, kept by reference; of: its drawings and settings; load, torque: N and N m on its driving gear, by the balance
  // of rigid bodies.
  MeshRecord(const SystemModel& system, int m, const GearPairParameters& of, double load, double torque);
  // A position of over_period(), which may take all positions again.
  void take(const RestStep& step, const SystemSolution& solution, const SystemStatics& statics);
  // Least and greatest number of the pairs that carried load, in slices that have a contact line; -1 to 1 at least.
  std::pair<int, int> pairs() const { return {lowest_, highest_}; }
  // With columns for the pairs lowest to highest. All of StaticResult but harmonics, remarks and the contact of the reference pair.
  StaticResult finish(int lowest, int highest);

 private:
  void take_friction(Eigen::Index row, const SystemSolution& solution, const SystemPosition& position);
  void store_loads(int lowest, int highest);
  void store_root_stress();
  const SystemModel& system_;
  const GearMeshModel& model_;
  int m_;
  double load_;
  StaticResult result_;
  Eigen::VectorXd deflection_;                                 // (phase) m, without bearings
  std::vector<std::pair<Eigen::Index, LoadedSegment>> loads_;  // row, and what a pair carries there
  int lowest_ = 0, highest_ = 0;
  std::optional<FaceRecord> face_;  // in slices
};

// transmission_error_harmonic, stiffness_harmonic and, where teeth differ, transmission_error_order.
void add_harmonics(StaticResult& mesh);

}  // namespace whine
