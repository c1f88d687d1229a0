// Designs side by side on common axes: at rest and in motion, at one torque.
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

template <class Artifact>
struct OfDesign {
  std::string design;  // the name of its scene
  Artifact artifact;
};

// Of two to six designs, in their order, at the torque of the first. Throw Error(input) for fewer or more, for another torque or a
// direction missing or given twice.

// Static transmission error (a) and secant mesh stiffness (b) over the mesh period, amplitudes of the error's harmonics (c).
Figure compared_rest_figure(const std::vector<OfDesign<StaticResult>>& designs);

// Against mesh frequency, both directions: RMS of the dynamic transmission error (a), its first harmonic (b), the largest tooth
// load over that of rigid gears with one pair, T / r_b (c).
Figure compared_motion_figure(const std::vector<OfDesign<ResponseResult>>& sweeps);

}  // namespace whine
