// The content of a report from its files.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"
#include "report/system_report.h"

namespace whine {

// Artifacts of one scene (static.h5, impact.h5, sweep.h5, error_budget.h5) and figures (.png), in any order; torques in the
// order of their static.h5. Throws Error(usage) for another artifact, Error(input) for a picture that is not whole, a sweep of a
// lumped model or one without the static.h5 of its torque, artifacts of several scenes or as require_one_pair, and as the
// readers of artifacts do.
ReportContent read_report_content(const std::vector<std::string>& paths);

// Whether one of the files is an artifact of a system of several meshes.
bool is_of_system(const std::vector<std::string>& paths);

// The same of a system: static.h5 and modes.h5, or of rigid gears modes.h5 alone, and figures. Throws as above, and
// Error(usage) for an artifact that is given twice.
SystemReport read_system_report(const std::vector<std::string>& paths);

}  // namespace whine
