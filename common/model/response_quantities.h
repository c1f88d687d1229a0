// The response quantities of a variant of a study: names, units, meanings.
#pragma once
#include <string>
#include <vector>

#include "model/stages.h"

namespace whine {

// What is asked of each variant.
struct ResponseQuantity {
  std::string name, units, meaning;
};

// At rest, then for each direction of a sweep, whose name ends with it.
std::vector<ResponseQuantity> response_quantities(const std::vector<Direction>& directions);

}  // namespace whine
