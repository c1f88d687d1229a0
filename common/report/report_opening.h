// The first five lines of a report, at the first torque of its scene.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

// Excitation, critical speeds, contact, dynamic factor, what to change, as far as the artifacts hold them; see opening.h. Meshes of one
// [[mesh]] are said together.
std::vector<std::string> opening_lines(const ReportContent& content);

}  // namespace whine
