// Root stress of the teeth of a mesh under the loads of its pairs.
//
//   sigma_q(s) = sum over the pairs p of T_(j_q - j_p)(s, xi_p) F_p
// s along the root, j_p the tooth of a gear in pair p, xi_p the roll angle at which it is touched, T the tables of
// solid/root_stress.h. The load of a pair stands at its touching point: a root is far away from the spread of the pressure. Inertia
// of what the kept modes leave out adds nothing.
#pragma once
#include <array>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "system/rolling_mesh.h"

namespace whine {

struct RootStress {
  double stress = -std::numeric_limits<double>::infinity();  // Pa: largest along the root, tension positive
  int pair = 0;                                              // of which tooth
  double angle = 0;  // rad: of the root's tangent there against the centre line
};

class RootStresses {
 public:
  // model is kept by reference. phases: mesh phases (0 to 1) by whose index loads are given.
  RootStresses(const GearMeshModel& model, std::vector<double> phases);
  // False for bodies without tables and for cracked gears, whose tables are those of intact ones; then nothing else may be asked.
  bool known() const { return known_; }
  // Of gear g beside the loaded flank: the tooth of each pair in `numbers`; load: (pair) N. Parabola through the three points
  // about the largest.
  std::vector<RootStress> of_teeth(int g, size_t phase, const Eigen::VectorXi& numbers,
                                   const Eigen::Ref<const Eigen::VectorXd>& load);
  RootStress largest(int g, size_t phase, const Eigen::VectorXi& numbers,
                     const Eigen::Ref<const Eigen::VectorXd>& load);

 private:
  // (root, offset) Pa N-1 of gear g under a unit force of a pair.
  const Eigen::MatrixXd& per_force(int g, size_t phase, int pair);
  const GearMeshModel& model_;
  std::vector<double> phases_;
  std::array<std::map<std::pair<size_t, int>, Eigen::MatrixXd>, 2> per_force_;  // [gear] by phase and pair
  bool known_;
};

}  // namespace whine
