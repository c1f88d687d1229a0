// The gap of two unloaded flanks at a contact point (Eq. 13).
#include "gear/pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/format.h"

namespace whine {

double GearPair::roll_at(int g, const PairContact& c, double x) const {
  const double rb = gear_[g].base_radius(), sign = along_[static_cast<size_t>(g)];
  // An involute has the length rb roll^2 / 2 from its base circle: near it a step along the tangent would leave the flank.
  const double squared = c.roll[g] * c.roll[g] + 2 * sign * x / rb;
  double roll = std::sqrt(std::max(squared, 1e-4 * c.roll[g] * c.roll[g]));
  for (int i = 0; i < 50; ++i) {
    const double d = roll - c.nominal[g];
    const Vec2 place = rotated(flank_in_nominal_frame(g, c.nominal[g], roll) - c.origin, c.tilt);
    const Vec2 slope = sign * rb * roll * rotated(Vec2(std::cos(d), -std::sin(d)), c.tilt);
    const double step = (x - place.x()) / slope.x();
    roll += step;
    if (std::abs(step) < 1e-15 * std::abs(roll)) return roll;
  }
  // Newton on a nearly straight curve ends in 3 steps; the last steps only dither within round-off.
  const double miss = rotated(flank_in_nominal_frame(g, c.nominal[g], roll) - c.origin, c.tilt).x() - x;
  if (std::abs(miss) > 1e-14)
    fail(Failure::numerical, "no flank point at tangential distance ", millimetres(x), " (missed by ", miss,
         " m)");
  return roll;
}

FlankGap GearPair::gap_at(const PairContact& c, double x) const {
  FlankGap result;
  double height[2];
  for (int g = 0; g < kSides; ++g) {
    result.roll[g] = roll_at(g, c, x);
    height[g] = rotated(flank_in_nominal_frame(g, c.nominal[g], result.roll[g]) - c.origin, c.tilt).y();
  }
  result.gap = height[1] - height[0];
  return result;
}

double GearPair::nearest(const PairContact& c, const PairDeviation& deviation) const {
  if (deviation.none() || !c.on_flank) return 0;
  // The exact flanks part by x^2 / (2 R) at least, within the range of the deviations no farther than this.
  double range = 0;
  for (const FlankDeviation* flank : deviation.gear)
    if (flank) range += flank->spread();
  constexpr double kMargin = 1.2;  // over R, which changes along the flank
  const double reach = kMargin * std::sqrt(2 * relative_curvature_radius(c) * range);
  double low = std::max(c.x_min, -reach), high = std::min(c.x_max, reach);
  if (!(high > low)) return std::clamp(0.0, c.x_min, c.x_max);

  const auto gap = [&](double x) { return gap_at(c, x, deviation); };
  constexpr int kPlaces = 32;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  const double step = (high - low) / kPlaces;
  for (int i = 0; i <= kPlaces; ++i)
    if (const double here = gap(low + i * step); here < least) {
      least = here;
      best = i;
    }
  const double end = high;
  high = std::min(end, low + (best + 1) * step);
  low = std::max(low, low + (best - 1) * step);
  // Golden section: a relief starts with a corner, where there is no derivative.
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = gap(a), at_b = gap(b);
  while (high - low > 1e-11) {
    if (at_a <= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - golden * (high - low);
      at_a = gap(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + golden * (high - low);
      at_b = gap(b);
    }
  }
  double x = 0.5 * (low + high);
  for (const double edge : {c.x_min, c.x_max, 0.0})  // found exactly, if it is one of these
    if (edge >= c.x_min && edge <= c.x_max && gap(edge) <= gap(x)) x = edge;
  return x;
}

}  // namespace whine
