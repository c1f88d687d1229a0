// Root stress of the teeth of a mesh under the loads of its pairs.
//
//   sigma_q(s) = sum over the pairs p of T_(j_q - j_p)(s, xi_p) F_p
// s along the root beside the loaded flank, j_p the tooth of a gear in pair p, xi_p the roll angle at which it is touched, T the
// tables of solid/root_stress.h, and near a cracked tooth with what its crack adds (solid/crack.h). The load of a pair acts at its touching point: a root is far away from the spread of the
// pressure, on the width b_e of a gear wider than its mate (gear/face_width.h): T times b / b_e. In motion this is quasi-static in the loads of the teeth: T holds all of the static flexibility, kept modes included,
// and the inertia of the body, kept modes included, adds none.
#pragma once
#include <array>
#include <vector>

#include "system/rolling_mesh.h"

namespace whine {

struct RootStress {
  double stress = 0;  // Pa: largest along the root, tension positive
  int pair = 0;       // of which tooth
  double angle = 0;   // rad: of the root's tangent there against the centre line
};

// Of the tooth in pair `of`: the largest of the stresses (root) Pa at points with these angles (root) rad, by a parabola through the three
// points about it.
RootStress largest_along(const Eigen::Ref<const Eigen::VectorXd>& stress, const Eigen::VectorXd& angle,
                         int of);

class RootStresses {
 public:
  // model is kept by reference. phases: mesh phases (0 to 1) by whose index loads are given.
  RootStresses(const GearMeshModel& model, std::vector<double> phases);
  // False for bodies without tables; then nothing else may be asked.
  bool known() const { return known_; }
  // Of gear g beside the loaded flank: of the tooth in pair `of`; load: (pair) N of the pairs `numbers`. period: of a cracked gear, for the
  // teeth that are in mesh in it.
  RootStress of_tooth(int g, size_t phase, int of, const Eigen::VectorXi& numbers,
                      const Eigen::Ref<const Eigen::VectorXd>& load, int period = 0);
  // Of the teeth that carry load; 0 where none does. Neighbours without load are not looked at.
  RootStress largest(int g, size_t phase, const Eigen::VectorXi& numbers,
                     const Eigen::Ref<const Eigen::VectorXd>& load, int period = 0);

 private:
  struct PerForce {
    int pair = 0;
    Eigen::VectorXd weights;  // (flank) 1: of the table's points where the pair is touched
    Eigen::MatrixXd table;    // (root, offset) Pa N-1
  };
  // Of gear g under a unit force of a pair, without cracks.
  const PerForce& per_force(int g, size_t phase, int pair);
  const GearMeshModel& model_;
  std::vector<double> phases_;
  std::array<std::vector<std::vector<PerForce>>, 2>
      per_force_;          // [gear][phase] of the pairs that were asked for
  Eigen::VectorXd along_;  // (root) Pa
  bool known_;
};

}  // namespace whine
