// How the teeth of a gear bend under forces on its driving flanks, for whoever draws them.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "results/sector_grid.h"

namespace whine {

struct FlankForce {
  int tooth;     // counter-clockwise
  double roll;   // rad
  double force;  // N
};

// (x, y of each node) m: displacement of nodes of tooth `j`, the hub held, in the frame of tooth 0.
using ToothBending = std::function<Eigen::VectorXd(int j, const std::vector<FlankForce>& forces)>;

// What finds it for nodes of a sector: tooth_bending() of solid. contact_width: m, on which the mesh meets.
using FindBending = ToothBending (*)(const SectorGrid& mesh, const Material& material, double contact_width,
                                     const std::vector<int>& nodes);

}  // namespace whine
