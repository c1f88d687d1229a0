// A crack in the root of one tooth: a straight slit through the whole face width.
//
// It opens where the fillet is in tension, on the side of the driving flank, and runs into the tooth. Its mouth is the
// point of the root trochoid whose tangent makes the angle `start` with the tooth's centre line (30 degrees: the critical
// section of ISO 6336-3), its direction makes the angle `angle` with the centre line: 0 straight to the axis, 90 degrees
// straight across to the other flank.
#pragma once
#include "gear/involute.h"

namespace whine {

struct Slit {
  double mouth_at = 0;  // parameter of the mouth on the root curve, see ToothGeometry::root_point
  Vec2 mouth = Vec2::Zero(), tip = Vec2::Zero();  // m, frame of the tooth
};

// Of gear.design().crack, whose depth is above 0. Throws Error(input) for a tooth that the gear has not, a mouth that is not
// on the fillet, and a slit that leaves less than a quarter of a module of the tooth, or comes nearer than that to the bore
// or to the next tooth.
Slit crack_slit(const ToothGeometry& gear);

}  // namespace whine
