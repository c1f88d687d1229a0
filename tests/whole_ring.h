// Rings and their meshes for tests of the solid.
#pragma once
#include "internal_pair.h"
#include "results/reduced_body.h"

namespace whine {

inline BodyDiscretisation elements(double size, int order = 2) {
  BodyDiscretisation d;
  d.element_size = size;
  d.element_order = order;
  return d;
}

inline GearDesign ring_of(int teeth, double module, double rim, double fillet = 0.3) {
  GearDesign d = ring_gear();
  d.teeth = teeth;
  d.module = module;
  d.tooth_thinning = 0;
  d.rack_tip_radius = fillet;
  d.rim_outer_radius = rim;
  return d;
}

// Sum of the tables of all offsets: what a flank gives way under unit forces on all teeth. Odd numbers of teeth alone.
inline Eigen::MatrixXd all_teeth(const ReducedBody& body) {
  const Eigen::Index n = body.flank_position.size();
  Eigen::MatrixXd sum = body.compliance[0];
  for (int d = 1; d <= body.offsets; ++d) sum += body.compliance[d] + body.compliance[d].transpose();
  const int teeth = body.design.teeth;
  for (int d = body.offsets + 1; d <= teeth / 2; ++d) {
    const Eigen::MatrixXd r = body.far_compliance.middleRows((d - body.offsets - 1) * n, n);
    sum += r + r.transpose();
  }
  return sum;
}

}  // namespace whine
