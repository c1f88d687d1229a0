// The lumped pair of the folds that another program found: rectangular stiffness at 150 N m, its damper always at work.
#pragma once
#include <cmath>

#include "lumped/oscillator.h"
#include "lumped/stiffness.h"

namespace whine {

inline LumpedParameters paper_wave(double ratio, double begin = 0) {
  LumpedParameters p = cells_of(RectangularWave{335596523.71, 504267825.43, begin, begin + 0.75});
  p.mass = 1.4;
  p.damping_ratio = ratio;
  p.damper = 2 * ratio * std::sqrt(462.1e6 * 1.4);
  p.damper_acts = DamperActs::always;
  return p;
}
inline constexpr double kPaperForce = 150 / 0.0704769466;  // N

}  // namespace whine
