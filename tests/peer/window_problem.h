// The strips of three neighbouring tooth pairs in parts, as a step has them: windows on their half-planes, on bodies that are
// given between nodes; and the same put together by Eigen.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "contact/half_plane_strip.h"
#include "contact/strip_compliance.h"
#include "contact/strips.h"
#include "strip_problems.h"

namespace whine {

struct ZoneProblem {
  static constexpr int kPairs = 3, kStrips = 20, kNodes = StripCompliance::kPairNodes;
  // Vectors keep their memory when a problem is moved, and so do the places that `parts` points to.
  std::vector<double> half_plane[kPairs], interpolation[kPairs], at_nodes;
  StripCompliance parts;
  Eigen::MatrixXd a;    // (strip, strip) m N-1
  Eigen::VectorXd gap;  // (strip) m

  ZoneProblem(ZoneProblem&&) = default;
  // phase: of the middle pair; c: (node, node) m N-1.
  ZoneProblem(double phase, const Eigen::MatrixXd& c) {
    const GearDesign design = strip_gear();
    const GearPair gears(design, design, 0.150);
    const HalfPlaneSurface surface({207e9, 0.3, 7600, false}, design.face_width);
    const int n = kPairs * kStrips, nodes = kPairs * kZoneNodes;
    Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, nodes), rows = Eigen::MatrixXd::Zero(kPairs * kNodes, nodes);
    a = Eigen::MatrixXd::Zero(n, n);
    gap.resize(n);
    for (int j = 0; j < kPairs; ++j) {
      const PairStrips s = make_strips(gears, j - 1, gears.contact(phase + j - 1), {2e-4, kStrips, 1e-5});
      const Eigen::MatrixXd h = half_plane_compliance(s, surface, surface, 1e-3);
      half_plane[j].assign(h.data(), h.data() + h.size());
      interpolation[j].assign(kStrips * kNodes, 0.0);
      std::copy(s.interpolation.data(), s.interpolation.data() + s.interpolation.size(),
                interpolation[j].begin());
      l.block(j * kStrips, j * kZoneNodes, kStrips, kZoneNodes) = s.interpolation;
      a.block(j * kStrips, j * kStrips, kStrips, kStrips) = h;
      gap.segment(j * kStrips, kStrips) = s.gap;
      rows.middleRows<kZoneNodes>(j * kNodes) = c.middleRows<kZoneNodes>(j * kZoneNodes);
    }
    a += l * c * l.transpose();
    at_nodes.assign(rows.data(), rows.data() + rows.size());
    parts.pairs = kPairs;
    parts.strips = kStrips;
    for (int j = 0; j < kPairs; ++j) {
      parts.half_plane[j] = half_plane[j].data();
      parts.interpolation[j] = interpolation[j].data();
    }
    parts.at_nodes = at_nodes.data();
  }
};

}  // namespace whine
