// Root stress of the meshes of a motion by the loads that their teeth carry, for sweeps, branches and run-ups.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "results/sweep.h"
#include "system/root_stress.h"
#include "system/system.h"

namespace whine {

// Of one mesh, at samples of the mesh period of the system (system/root_stress.h); period and phase of the mesh itself are ahead of those.
class MotionRootStress {
 public:
  // system is kept by reference. samples: of a mesh period, sample 0 at its start.
  MotionRootStress(const SystemModel& system, Eigen::Index mesh, int samples);
  // False for bodies without tables and for slices, whose load is not even over the face; then nothing else may be asked.
  bool known() const { return known_; }
  // Mesh periods by which the mesh is ahead at a sample: a pair is number i + ahead in it that is i in the period of the system.
  int ahead(Eigen::Index sample) const { return instant_[at(sample)].period; }
  // Pa: largest of the teeth of a side that carry load, at a sample that counts on from mesh period 0. load: (pair) N of the pairs `numbers`
  // of the mesh.
  RootStress largest(int side, Eigen::Index sample, const Eigen::VectorXi& numbers,
                     const Eigen::Ref<const Eigen::VectorXd>& load);
  // 1: mesh phase of the pair of a tooth at a sample, 0 at the pitch point.
  double phase(Eigen::Index sample, const RootStress& of) const {
    return instant_[at(sample)].phase + of.pair;
  }

 private:
  size_t at(Eigen::Index sample) const { return static_cast<size_t>(sample) % instant_.size(); }
  std::vector<MeshInstant> instant_;  // [sample]
  RootStresses roots_;
  bool known_;
};

// Fills root_stress, root_stress_angle and root_stress_phase from /tooth_load, at the samples that are stored. They stay empty where no
// mesh has bodies with tables of root stress.
void add_root_stress(const SystemModel& system, SweepResult& sweep);

}  // namespace whine
