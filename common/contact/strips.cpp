#include "contact/strips.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "contact/lanes.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// n strips between low and high; low_grade, high_grade: 0 for strips of one width, 1 for widths that grow with
// the root of the distance from that end. The width goes with (1 - low_grade + 2 low_grade t) (1 + high_grade - 2
// high_grade t), t from 0 at low to 1 at high.
VectorXd strip_borders(double low, double high, double low_grade, double high_grade, int n) {
  constexpr double kRoundOff = 1e-9;
  for (const double grade : {low_grade, high_grade})
    if (!(grade >= -kRoundOff && grade <= 1 + kRoundOff) || !(high > low))
      fail(Failure::numerical, "the flanks of a pair face each other from ", low * 1e3, " to ", high * 1e3,
           " mm of the contact point, grades ", low_grade, " and ", high_grade,
           " (0 to 1): no candidate zone of strips fits between");
  const double a = 1 - low_grade, b = 2 * low_grade, c = 1 + high_grade, d = 2 * high_grade;
  const auto primitive = [&](double t) { return t * (a * c + t * (0.5 * (b * c - a * d) - t * b * d / 3)); };
  VectorXd border(n + 1);
  for (int i = 0; i <= n; ++i)
    border[i] = low + (high - low) * primitive(static_cast<double>(i) / n) / primitive(1);
  border[n] = high;
  return border;
}

}  // namespace

PairStrips make_strips(const GearPair& gears, int pair, const PairContact& contact,
                       const CandidateZone& range, const PairDeviation& deviation) {
  PairStrips s;
  s.pair = pair;
  s.contact = contact;
  // Which end of the flanks is an edge: the driver's tip at x_max, the driven gear's at x_min, or where the other flank is undercut.
  // The other limits are the roots, where strips must not carry force.
  const int n = range.strips;
  const double offset = 0.5 * range.half_zone / n;  // a quarter strip
  const double centre = range.follows ? gears.nearest(contact, deviation) : 0;
  double low = centre + offset - range.half_zone, high = centre + offset + range.half_zone;
  if (low <= contact.x_min) {
    low = contact.x_min;
    s.low_is_edge = std::isfinite(gears.edge_distance(contact, 1));
  }
  if (high >= contact.x_max) {
    high = contact.x_max;
    s.high_is_edge = std::isfinite(gears.edge_distance(contact, 0));
  }
  s.border = strip_borders(low, high, s.low_is_edge ? 1 - (centre - low) / (range.half_zone - offset) : 0,
                           s.high_is_edge ? 1 - (high - centre) / (range.half_zone + offset) : 0, n);
  s.gap.resize(n);
  const bool differs = deviation.differs();
  for (int g = 0; differs && g < kSides; ++g) s.gap_roll[g].resize(2 * n);
  const auto gap = [&](double x, int place) {
    const FlankGap exact = gears.gap_at(contact, x);
    for (int g = 0; differs && g < kSides; ++g) s.gap_roll[g][place] = exact.roll[g];
    return exact.gap;
  };
  for (int i = 0; i < n; ++i) {
    // Gauss's two points: the mean of a cubic.
    const double reach = 0.5 * s.width(i) / std::numbers::sqrt3;
    s.gap[i] = 0.5 * (gap(s.middle(i) - reach, 2 * i) + gap(s.middle(i) + reach, 2 * i + 1));
  }
  if (!deviation.none()) s.gap += mean_deviation(gears, s, deviation);

  // Chebyshev points of the first kind and their barycentric weights.
  VectorXd node(kZoneNodes), weight(kZoneNodes);
  for (auto& roll : s.node_roll) roll.resize(kZoneNodes);
  for (int k = 0; k < kZoneNodes; ++k) {
    const double angle = (2 * k + 1) * std::numbers::pi / (2 * kZoneNodes);
    node[k] = 0.5 * (low + high) - 0.5 * (high - low) * std::cos(angle);
    weight[k] = (k % 2 ? -1 : 1) * std::sin(angle);
    const FlankGap at = gears.gap_at(contact, node[k]);
    for (int g = 0; g < kSides; ++g) s.node_roll[g][k] = at.roll[g];
  }
  s.interpolation.resize(n, kZoneNodes);
  for (int i = 0; i < n; ++i) {
    const double x = s.middle(i);
    double sum = 0;
    int hit = -1;
    for (int k = 0; k < kZoneNodes; ++k) {
      if (x == node[k]) hit = k;
      s.interpolation(i, k) = weight[k] / (x - node[k]);
      sum += s.interpolation(i, k);
    }
    if (hit >= 0)
      s.interpolation.row(i) = Eigen::RowVectorXd::Unit(kZoneNodes, hit);
    else
      s.interpolation.row(i) /= sum;
  }
  return s;
}

VectorXd mean_deviation(const GearPair& gears, const PairStrips& strips, const PairDeviation& deviation) {
  VectorXd mean(strips.size());
  for (int i = 0; i < strips.size(); ++i) {
    const double reach = 0.5 * strips.width(i) / std::numbers::sqrt3;
    mean[i] = 0.5 * (deviation.at(gears.gap_at(strips.contact, strips.middle(i) - reach).roll) +
                     deviation.at(gears.gap_at(strips.contact, strips.middle(i) + reach).roll));
  }
  return mean;
}

MatrixXd half_plane_compliance(const PairStrips& strips, const HalfPlaneSurface& driver,
                               const HalfPlaneSurface& driven, double depth) {
  const int n = strips.size();
  const auto between = [&](int i, int j) {
    double sum = 0;
    for (const HalfPlaneSurface* surface : {&driver, &driven})
      sum += surface->mean_over_strip(strips.middle(i) - strips.middle(j), 0.5 * strips.width(j),
                                      0.5 * strips.width(i), depth);
    return sum;
  };
  MatrixXd a(n, n);
  double narrowest = strips.width(0), widest = narrowest;
  for (int i = 1; i < n; ++i) {
    narrowest = std::min(narrowest, strips.width(i));
    widest = std::max(widest, strips.width(i));
  }
  if (widest - narrowest < 1e-9 * widest) {  // of one width: a Toeplitz matrix
    for (int i = 0; i < n; ++i) a(i, 0) = between(i, 0);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) a(i, j) = a(std::abs(i - j), 0);
    return a;
  }
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) a(i, j) = a(j, i) = between(i, j);
  return a;
}

CandidateZone candidate_zone(const GearPair& gears, const HalfPlaneSurface& driver,
                             const HalfPlaneSurface& driven, int across, double mean_force,
                             double largest_force, double corner_gap, const PairDeviation& deviation) {
  // Hertz, line contact: a^2 = 4 W R / (pi E*), in terms of the half-planes' log coefficient C = 2 W / (pi E*
  // F).
  const double radius = gears.largest_relative_curvature_radius();
  const auto half_width = [&](double force) {
    return std::sqrt(2 * radius * force * (driver.coefficient() + driven.coefficient()));
  };
  CandidateZone range;
  // Flanks of slope s touch R s beside the nominal point, and not where the gap is larger than what they deviate by.
  double slope = 0, spread = 0;
  for (const FlankDeviation* flank : deviation.gear)
    if (flank) {
      slope += flank->steepest();
      spread += flank->spread();
    }
  const double width = half_width(largest_force),
               move = std::min(radius * slope, std::sqrt(2 * radius * spread));
  // One candidate zone holds all teeth.
  range.follows = move > width && !deviation.differs();
  range.half_zone = width + (range.follows ? width : move);
  range.strips =
      padded(std::max(4, static_cast<int>(std::ceil(across * range.half_zone / half_width(mean_force)))));
  range.corner_gap = corner_gap;
  return range;
}

ContactPatch contact_patch(const PairStrips& strips, const Eigen::Ref<const VectorXd>& p, double face_width) {
  const int n = strips.size();
  const double force = p.sum();
  ContactPatch patch;
  if (!(force > 0) || strips.contact.corner || p[0] > 0 || p[n - 1] > 0) return patch;
  double mean = 0, square = 0;
  for (int i = 0; i < n; ++i) mean += p[i] / force * strips.middle(i);
  for (int i = 0; i < n; ++i) {
    const double x = strips.middle(i) - mean;
    // A strip is evenly loaded: its own variance is width^2 / 12.
    square += p[i] / force * (x * x + strips.width(i) * strips.width(i) / 12);
    patch.pressure = std::max(patch.pressure, p[i] / (strips.width(i) * face_width));
  }
  patch.half_width = 2 * std::sqrt(square);
  return patch;
}

}  // namespace whine
