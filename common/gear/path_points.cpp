#include "gear/path_points.h"

#include <cmath>

namespace whine {

std::array<PathPoint, 5> path_points(const GearPair& pair) {
  const double first = pair.path_start(), last = pair.path_end(), pitch = pair.base_pitch();
  std::array<PathPoint, 5> points{PathPoint{'A', first, {}},
                                  {'B', last - pitch, {}},
                                  {'C', 0.0, {}},
                                  {'D', first + pitch, {}},
                                  {'E', last, {}}};
  for (PathPoint& p : points)
    for (int g = 0; g < kSides; ++g) {
      const double base = pair.gear(g).base_radius();
      p.diameter[static_cast<size_t>(g)] = 2 * std::hypot(base, base * pair.nominal_roll(g, p.path));
    }
  return points;
}

}  // namespace whine
