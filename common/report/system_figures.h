// A system of elastic gears at rest: what its meshes and bearings do over a mesh period.
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"
#include "results/static.h"

namespace whine {

// Transmission error and force of each mesh, size of the force on each bearing, pin and axis; the notes say how planets share
// the load.
Figure system_static_figure(const SystemStaticResult& a);

// How the planets' meshes of one [[mesh]] share the load.
struct LoadSharing {
  std::string name;            // "sun-planet", its gears
  std::vector<size_t> meshes;  // numbers in the layout, two at least
  double factor = 0;       // 1: largest share at any phase times number of meshes; 1 where all carry the same
  double mean_factor = 0;  // 1: the same of the mean over the mesh period
};
std::vector<LoadSharing> load_sharing(const SystemStaticResult& a);

// Of each [[mesh]] of planets the share of each over the mesh period, and the loads of the tooth pairs of its first mesh. Throws
// Error(input) for a system without planets.
Figure system_load_sharing_figure(const SystemStaticResult& a);

}  // namespace whine
