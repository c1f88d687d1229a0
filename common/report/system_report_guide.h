// "What the numbers mean" of the report of a system.
#pragma once
#include <string>

#include "report/system_report.h"

namespace whine {

// As HTML: the rows of what is on the page.
std::string system_guide(const SystemReport& report);

}  // namespace whine
