// Geometry of the pair for the table of results.
#pragma once
#include <string>
#include <vector>

#include "signal/static_result.h"

namespace whine {

struct GeometryNumber {
  std::string quantity, unit, value;
};

// Contact ratio, mesh and diameters; of a gear "..., <name> (driver)".
std::vector<GeometryNumber> pair_geometry(const StaticArtifact& statics);

}  // namespace whine
