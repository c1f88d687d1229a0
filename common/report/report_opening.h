// The first five lines of the report of a pair, at the first torque of its scene.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

// Excitation, critical speeds, contact, dynamic factor, what to change; see opening.h.
std::vector<std::string> opening_lines(const ReportContent& content);

}  // namespace whine
