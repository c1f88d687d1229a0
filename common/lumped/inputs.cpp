#include "lumped/inputs.h"

#include "lumped/stiffness.h"

namespace whine {
namespace {

constexpr int kHertzChords = 16;  // 4e-4 from the law itself over two mesh periods with contact loss

}  // namespace

LumpedParameters springs_of(const LumpedInputs& inputs, const SpringChoice& choice,
                            Eigen::VectorXi& numbers) {
  const StaticResult& pair = inputs.at_torque;
  numbers = Eigen::VectorXi::Zero(1);
  if (choice.model == MotionModel::rectangular)
    return cells_of(choice.stated ? stated_wave(pair, choice.fewer, choice.more, choice.duty)
                                  : inputs.at_reference.rectangular_wave);
  const int positions = static_cast<int>(pair.mesh_phase.size());
  const int cells = choice.cells > 0 ? choice.cells : positions * ((1023 + positions) / positions);
  if (choice.model == MotionModel::pairs) return cells_of_pairs(pair, cells, numbers);
  if (choice.model == MotionModel::pairs_hertz) return cells_of_pairs(pair, cells, numbers, kHertzChords);
  return cells_of(choice.model == MotionModel::secant ? pair.stiffness_secant : pair.stiffness_tangent, cells,
                  pair.unloaded_error);
}

}  // namespace whine
