// What contact in slices does to bodies along their axes and across them: axial forces and tilting moments.
//
// A force F along the normal of a tooth pair has the axial part F sin(beta_b) on the driving gear, towards the viewer who sees it turn
// counter-clockwise where its helix is right-hand; of a mesh that touches on its line of action the sum is F_t tan(beta_b). With the place r
// of the contact from the middle of the body M = r x F has parts across the axis: of axial forces at different places (a planet's
// sun and ring mesh push it to either side and tilt it), and of loads beside the middle of the face. Bodies do not tilt: what
// bearings or shafts have to hold is stated, and has no effect.
#pragma once
#include <vector>

#include "system/system.h"

namespace whine {

// z: towards the viewer of the system. What a body presses on its bearing with, as bearing_force(); of a carrier what its planets press on it
// with, moments about its own middle.
struct AxialLoads {
  std::vector<double> force;  // [body] N, along z
  std::vector<Vec2> moment;   // [body] N m, about x and y
};

// p: (strip) N, of a system in slices.
AxialLoads axial_loads(const SystemModel& system, const SystemPosition& position,
                       const Eigen::Ref<const Eigen::VectorXd>& p);

}  // namespace whine
