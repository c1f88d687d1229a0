// Transmission error against torque and tip relief.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// Whose tips are relieved.
enum class Relieved { driver, driven, both };
template <>
inline constexpr const char* kWordsOf<Relieved> = "driver driven both";
// Whether those of gear g are.
inline bool relieves(Relieved relieved, int g) {
  return relieved == Relieved::both || static_cast<int>(relieved) == g;
}

// harris_map.h5: transmission error of a pair at rest, or its motion at the worst speed, against torque and tip relief. What
// else is taken off the flanks is in `mesh`, whose tip reliefs are 0.
struct HarrisMapResult : MotionParameters, MeshSpeeds {
  Relieved relieved = Relieved::both;
  ReliefShape shape = ReliefShape::linear;
  Eigen::VectorXd torque;    // (torque) N m, ascending
  Eigen::VectorXd relief;    // (relief) m, ascending
  Eigen::VectorXd length;    // (start) m: length of roll from where the relief starts to the tip edge
  MatrixRM start_roll;       // (start, gear) rad: the same as roll angles on driver and driven gear
  double design_torque = 0;  // N m
  std::vector<MatrixRM> peak_to_peak;             // [start] (torque, relief) m
  std::array<std::vector<MatrixRM>, 3> harmonic;  // first three, amplitudes: [start] (torque, relief) m
  // (start) m: least peak to peak at the design torque, and the relief that has it, between those of the map
  Eigen::VectorXd optimum_relief, optimum_peak_to_peak;
  MatrixRM cusp;               // (start, torque) m: peak to peak of that relief
  Eigen::VectorXd unrelieved;  // (torque) m: peak to peak without tip relief
  int checked = 0;             // points that were solved again with finer strips and at more positions
  double largest_error = 0;    // 1: largest difference from those, over the peak to peak there
  // On demand, empty otherwise: the larger of the sweeps up and down at the speed where it is largest.
  std::vector<MatrixRM> dynamic_rms, worst_frequency;  // [start] (torque, relief) m, Hz
};

}  // namespace whine
