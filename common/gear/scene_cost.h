// Cost of a scene's settings, estimated before anything is computed.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

// CPU time and largest memory of one run of a stage, within a factor of 3 on a core of 3 GHz. Motions that take long to repeat, or never
// do, take up to a hundred times as long: contact loss of teeth that differ.
struct StageCost {
  std::string stage;               // "gear-reduce, pinion"
  double seconds = 0, memory = 0;  // s, bytes
  int runs = 1;
  std::string by = {};  // the settings that it goes with, in words
};
std::vector<StageCost> stage_costs(const Scene& scene);

// A line for each stage that takes more than a minute of CPU, a sweep more than ten; none for an ordinary scene. A program that computes
// says how far it is (base/progress.h).
std::vector<std::string> costs(const Scene& scene);

}  // namespace whine
