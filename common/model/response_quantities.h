// The response quantities of a variant of a study: names, units, meanings.
#pragma once
#include <string>
#include <vector>

#include "model/stages.h"
#include "model/system_stages.h"

namespace whine {

// What is asked of each variant.
struct ResponseQuantity {
  std::string name, units, meaning;
};

// What quantities of a train are of, by name; of a pair all lists are empty.
struct TrainNames {
  std::vector<std::string> meshes;  // "sun-planet1"
  std::vector<std::string> bodies;
  std::vector<std::string>
      shared;  // "sun-planet": each [[mesh]] that stands for several, of planets which share its load
  bool empty() const { return meshes.empty(); }
  bool operator==(const TrainNames&) const = default;
};
TrainNames train_names(const SystemStaticParameters& train);

// At rest, then for each direction of a sweep, whose name stands at the end: te_mean, rms_max_up. Of a train behind a dot the mesh,
// body or [[mesh]] that it is of: rms_max_up.sun-planet1; what a pair has too is called as there.
std::vector<ResponseQuantity> response_quantities(const std::vector<Direction>& directions,
                                                  const TrainNames& train = {});

// Whether a quantity is one of sweeps.
bool of_motion(const std::string& quantity);

}  // namespace whine
