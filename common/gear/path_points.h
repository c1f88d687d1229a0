// Where on the path of contact pairs come and go, and which diameters of the two gears are there.
#pragma once
#include <array>

#include "gear/pair.h"

namespace whine {

// Points A to E of ISO 21771 in the direction of the motion: A a pair comes into contact (start of the driver's active
// profile, SAP, and the driven gear's tip), B one base pitch before E, C the pitch point, D one base pitch after A, E the pair
// leaves (driver's tip, SAP of the driven gear). With a contact ratio of 1 to 2 one pair alone carries load from B to D,
// without load and errors.
struct PathPoint {
  char name;
  double path;                     // m from the pitch point, growing to the driver's tip
  std::array<double, 2> diameter;  // m, of driver and driven gear
};
std::array<PathPoint, 5> path_points(const GearPair& pair);

}  // namespace whine
