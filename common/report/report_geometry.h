// Geometry of the pair for the table of results.
#pragma once
#include <string>
#include <vector>

#include "results/static.h"

namespace whine {

struct GeometryNumber {
  std::string quantity, unit, value;
};

// Contact ratio, mesh and diameters; of a gear "..., <name> (driver)".
std::vector<GeometryNumber> pair_geometry(const StaticResult& statics);

}  // namespace whine
