#include "system/rectangular_wave.h"

#include <cmath>

#include "gear/pair.h"
#include "signal/spectrum.h"

namespace whine {

RectangularWave rectangular_wave(const StaticResult& s) {
  const GearPair pair(s);
  // A pair j, which touches the pitch point at phase j, is in contact from j + start to j + end.
  const double start = pair.path_start() / pair.base_pitch(), end = pair.path_end() / pair.base_pitch();
  const double few = std::floor(end - start);  // pairs in contact where they are fewest
  RectangularWave wave;
  // A new pair comes at start (modulo 1), the oldest leaves at end: between them there is one pair more.
  wave.high_begin = start - std::floor(start);
  wave.high_end = wave.high_begin + (end - start - few);
  const double middle = 0.5 * (wave.high_begin + wave.high_end);
  // From the first position on, which is another phase than 0 in a train.
  const double first = s.mesh_phase[0];
  const Eigen::VectorXd after = s.mesh_phase.array() - first;
  wave.high = at_phase(after, s.stiffness_secant, middle - first);
  wave.low = at_phase(after, s.stiffness_secant, middle + 0.5 - first);
  return wave;
}

}  // namespace whine
