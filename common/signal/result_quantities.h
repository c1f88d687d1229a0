// Response quantities of results by name, as studies and comparisons list them (model/response_quantities.h).
#pragma once
#include <map>
#include <string>

#include "model/system_stages.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

// Quantities of results in SI, by the names of response_quantities(). settings: of a train, to know which meshes share a load; else
// their sharing is left out.
using Quantities = std::map<std::string, double>;
Quantities quantities_of(const StaticResult& rest);
Quantities quantities_of(const SystemStaticResult& rest);
Quantities quantities_of(const ResponseResult& motion, const SystemStaticParameters* settings = nullptr);

}  // namespace whine
