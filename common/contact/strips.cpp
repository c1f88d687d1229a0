#include "contact/strips.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

PairStrips make_strips(const GearPair& gears, int pair, const PairContact& contact,
                       const ContactRange& range) {
  PairStrips s;
  s.pair = pair;
  s.contact = contact;
  // Which end of the flanks is a tip edge: the driver's at x_max or the driven gear's at x_min. The other
  // limits are the roots, where strips must not carry force.
  const auto is_tip = [&](int g, double x) {
    return std::abs(gears.gap_at(contact, x).roll[g] - gears.gear(g).tip_roll_angle()) < 1e-9;
  };
  double low = -range.half_window, high = range.half_window;
  if (low <= contact.x_min) {
    low = contact.x_min;
    s.low_is_edge = is_tip(1, low);
  }
  if (high >= contact.x_max) {
    high = contact.x_max;
    s.high_is_edge = is_tip(0, high);
  }
  const int n = range.strips;
  s.width = (high - low) / n;
  s.gap.resize(n);
  for (int i = 0; i < n; ++i) s.gap[i] = gears.gap_at(contact, low + (i + 0.5) * s.width).gap;

  // Chebyshev points of the first kind and their barycentric weights.
  VectorXd node(kWindowNodes), weight(kWindowNodes);
  for (auto& roll : s.node_roll) roll.resize(kWindowNodes);
  for (int k = 0; k < kWindowNodes; ++k) {
    const double angle = (2 * k + 1) * std::numbers::pi / (2 * kWindowNodes);
    node[k] = 0.5 * (low + high) - 0.5 * (high - low) * std::cos(angle);
    weight[k] = (k % 2 ? -1 : 1) * std::sin(angle);
    const FlankGap at = gears.gap_at(contact, node[k]);
    for (int g = 0; g < 2; ++g)
      s.node_roll[g][k] =
          std::clamp(at.roll[g], gears.gear(g).form_roll_angle(), gears.gear(g).tip_roll_angle());
  }
  s.interpolation.resize(n, kWindowNodes);
  for (int i = 0; i < n; ++i) {
    const double x = low + (i + 0.5) * s.width;
    double sum = 0;
    int hit = -1;
    for (int k = 0; k < kWindowNodes; ++k) {
      if (x == node[k]) hit = k;
      s.interpolation(i, k) = weight[k] / (x - node[k]);
      sum += s.interpolation(i, k);
    }
    if (hit >= 0)
      s.interpolation.row(i) = Eigen::RowVectorXd::Unit(kWindowNodes, hit);
    else
      s.interpolation.row(i) /= sum;
  }
  return s;
}

MatrixXd half_plane_compliance(const PairStrips& strips, const HalfPlaneSurface& driver,
                               const HalfPlaneSurface& driven, double depth) {
  const int n = strips.size();
  VectorXd by_distance(n);  // equal strips: a Toeplitz matrix
  for (int i = 0; i < n; ++i)
    by_distance[i] = driver.strip(i * strips.width, 0.5 * strips.width, depth) +
                     driven.strip(i * strips.width, 0.5 * strips.width, depth);
  MatrixXd a(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) a(i, j) = by_distance[std::abs(i - j)];
  return a;
}

ContactRange contact_range(const GearPair& gears, const HalfPlaneSurface& driver,
                           const HalfPlaneSurface& driven, int across, double mean_force,
                           double largest_force, double corner_gap) {
  // Hertz, line contact: a^2 = 4 W R / (pi E*), in terms of the half-planes' log coefficient C = 2 W / (pi E*
  // F).
  // rho1 rho2 / (rho1 + rho2) is a parabola along the path, highest midway between the tangent points.
  const double midway = 0.5 * std::tan(gears.working_pressure_angle()) *
                        (gears.gear(1).base_radius() - gears.gear(0).base_radius());
  const double radius =
      gears.relative_curvature_radius(std::clamp(midway, gears.path_start(), gears.path_end()));
  const auto half_width = [&](double force) {
    return std::sqrt(2 * radius * force * (driver.coefficient() + driven.coefficient()));
  };
  ContactRange range;
  range.half_window = half_width(largest_force);
  range.strips =
      std::max(4, static_cast<int>(std::ceil(across * range.half_window / half_width(mean_force))));
  range.corner_gap = corner_gap;
  return range;
}

ContactPatch contact_patch(const PairStrips& strips, const Eigen::Ref<const VectorXd>& p, double face_width) {
  const int n = strips.size();
  const double force = p.sum();
  ContactPatch patch;
  if (!(force > 0) || strips.contact.corner || p[0] > 0 || p[n - 1] > 0) return patch;
  double mean = 0, square = 0;
  for (int i = 0; i < n; ++i) mean += p[i] / force * (i + 0.5) * strips.width;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) * strips.width - mean;
    // A strip is as wide as the others and evenly loaded: its own variance is width^2 / 12.
    square += p[i] / force * (x * x + strips.width * strips.width / 12);
  }
  patch.half_width = 2 * std::sqrt(square);
  patch.pressure = p.maxCoeff() / (strips.width * face_width);
  return patch;
}

}  // namespace whine
