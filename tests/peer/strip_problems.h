// Contact problems as the gears bring them: strips of two neighbouring tooth pairs on their half-planes and on
// bodies that give way as a whole, at any phase of the mesh.
#pragma once
#include <Eigen/Core>
#include <numbers>

#include "contact/half_plane_strip.h"
#include "contact/strips.h"

namespace whine {

inline GearDesign strip_gear() {
  GearDesign design;
  design.teeth = 50;
  design.module = 3e-3;
  design.pressure_angle = 20 * std::numbers::pi / 180;
  design.face_width = 25.4e-3;
  design.bore_radius = 40e-3;
  return design;
}

struct StripProblem {
  Eigen::MatrixXd a;    // (strip, strip) m N-1
  Eigen::VectorXd gap;  // (strip) m; e = gap - approach
};

// phase: of the first pair, within -1 and 1; strips: per pair.
inline StripProblem strip_problem(double phase, int strips) {
  const GearDesign design = strip_gear();
  const GearPair gears(design, design, 0.150);
  const HalfPlaneSurface surface({207e9, 0.3, 7600, false}, design.face_width);
  const double neighbour = phase > 0 ? phase - 1 : phase + 1;
  StripProblem problem;
  problem.a.setConstant(2 * strips, 2 * strips, 4e-10);  // through the rims
  problem.gap.resize(2 * strips);
  for (int pair = 0; pair < 2; ++pair) {
    const PairStrips s = make_strips(gears,
                                     pair == 0   ? 0
                                     : phase > 0 ? -1
                                                 : 1,
                                     gears.contact(pair == 0 ? phase : neighbour), {2e-4, strips, 1e-5});
    auto block = problem.a.block(pair * strips, pair * strips, strips, strips);
    block.array() += 2e-9;  // through the teeth
    block += half_plane_compliance(s, surface, surface, 1e-3);
    problem.gap.segment(pair * strips, strips) = s.gap;
  }
  return problem;
}

}  // namespace whine
