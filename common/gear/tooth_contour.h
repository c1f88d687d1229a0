// The contour of a gear as it is drawn: both flanks, tip and root of each tooth, exact at its points.
#pragma once
#include <vector>

#include "gear/involute.h"

namespace whine {

// (point) m, in the body frame of gear/involute.h: tooth 0, counter-clockwise from the middle of one tooth space to the middle
// of the next one; the last point is the first one turned by a tooth. points: on each flank, 2 at least, and on each root.
std::vector<Vec2> tooth_contour(const ToothGeometry& gear, int points);

// (point) m: all teeth, closed, the first point again at the end.
std::vector<Vec2> gear_contour(const ToothGeometry& gear, int points);

// (point) m: a closed circle about the origin, the first point again at the end.
std::vector<Vec2> circle_contour(double radius, int points);

}  // namespace whine
