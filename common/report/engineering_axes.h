// Figures in the axes that engineers use: speed as the rotation of a gear, amplitudes as levels.
//
//   n = 60 f / z   (rpm; f mesh frequency in Hz, z teeth of the gear; of trains 60 f |turns|, train_speeds()),   L = 20 log10(RMS / reference)   (dB), RMS = a / sqrt(2) of a
//   harmonic of amplitude a
#pragma once
#include <optional>
#include <string>

#include "report/figures.h"

namespace whine {

struct EngineeringAxes {
  std::string
      speed;  // "rpm:<gear>", a gear or carrier by its name, of a pair also "rpm:driver", "rpm:driven"; empty: mesh frequency in Hz
  std::optional<double> level_reference = {};  // m: levels in dB re this; none: in µm
};

// Columns, numbers and words of the figure; columns are renamed by their new unit, so do the speeds in keys and above panels; notes stay in Hz. Axes of
// levels reach down to the least, by 80 dB at most; an amplitude of nothing stands 300 dB below it. Throws Error(usage) for a
// figure that is not against speed, gears that differ in teeth, a gear that it does not have or that stands still, a train of which it does not follow how its carrier turns, a figure without amplitudes of the
// transmission error, a reference that is no length above 0.
void apply(const EngineeringAxes& axes, Figure& figure);

}  // namespace whine
