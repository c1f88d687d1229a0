// The meshes of a train that come from one [[mesh]] of its scene, and how they share the load.
#pragma once
#include <string>
#include <vector>

#include "results/static.h"

namespace whine {

struct AlikeMeshes {
  std::string name;            // "sun-planet", its gears
  std::vector<size_t> meshes;  // numbers in the layout
};
// In the order of the scene; of a pair its one mesh, without a name.
std::vector<AlikeMeshes> alike_meshes(const SystemStaticResult& a);

// Whether it is one of several meshes of a [[mesh]], which share its load.
bool shares_load(const SystemStaticResult& a, size_t m);

// Of planets: two meshes at least.
struct LoadSharing : AlikeMeshes {
  double factor = 0;       // 1: largest share at any phase times number of meshes; 1 where all carry the same
  double mean_factor = 0;  // 1: the same of the mean over the mesh period
};
std::vector<LoadSharing> load_sharing(const SystemStaticResult& a);

}  // namespace whine
