// Ridges of a modified flank: where linear relief begins, or a table of points ends with a slope.
//
// There the slope of the flank jumps, and the pressure of a contact over it has no largest value: beside a ridge that bends
// by delta it grows as (E* delta / 2 pi) ln(1 / distance) (Johnson, Contact Mechanics, 1985, section 5.2: a wedge).
#pragma once
#include <string>
#include <vector>

#include "gear/flank_deviation.h"
#include "model/gear.h"

namespace whine {

struct FlankRidge {
  double roll = 0;    // rad
  double bend = 0;    // 1, > 0: jump of the slope of what is taken off, against the arc length of the flank
  std::string cause;  // in words: "linear tip relief"
};

// Errors as FlankDeviation.
std::vector<FlankRidge> flank_ridges(const ToothGeometry& gear, const FlankModification& modification);

}  // namespace whine
