// The content of a report from its files.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

// Artifacts of one scene, a pair or a train (static.h5, impact.h5, response.h5, error_budget.h5, sweep_errors.h5, modes.h5) and figures
// (.png), in any order; torques in the order of their static.h5. Throws Error(usage) for another artifact and a second modes.h5,
// Error(input) for a picture that is not whole, a sweep of a lumped model, artifacts of several scenes or made from different versions of
// one file, or as require_one_scene, and as the readers of artifacts do.
ReportContent read_report_content(const std::vector<std::string>& paths);

}  // namespace whine
