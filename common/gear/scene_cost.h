// Cost of a scene's settings, estimated before anything is computed.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "model/system_scene.h"

namespace whine {

// CPU time and largest memory of one run of a stage, within a factor of 2 on a core of 3 GHz.
struct StageCost {
  std::string stage;               // "gear-reduce, pinion"
  double seconds = 0, memory = 0;  // s, bytes
  int runs = 1;
};
std::vector<StageCost> stage_costs(const Scene& scene);
std::vector<StageCost> stage_costs(const SystemScene& scene);

// A line for each choice of a scene that makes a stage take more than a minute of CPU by the measured laws in the source; none
// for an ordinary scene. A program that computes says how far it is (base/progress.h).
std::vector<std::string> costs(const Scene& scene);
// meshes: of the layout.
std::vector<std::string> costs(const SystemScene& scene, size_t meshes);

}  // namespace whine
