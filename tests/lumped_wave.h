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
// Hz: bounds of its first five tongues without damping, where a multiplier is 1 or -1; the damping ratio that closes each.
inline constexpr double kTongue[5][2] = {{5549.5652, 6016.2142},
                                         {2794.6650, 2976.3335},
                                         {1883.4157, 1958.1047},
                                         {1430.0199, 1450.5070},
                                         {1149.5595, 1155.9831}},
                        kTongueCloses[5] = {0.04041, 0.03151, 0.01945, 0.00711, 0.00279};
inline constexpr double kPaperForce = 150 / 0.0704769466;  // N

}  // namespace whine
