// The section "What the numbers mean" of a report: how to read each table and figure, how far to trust it, what to do next.
#pragma once
#include <string>

#include "report/report.h"

namespace whine {

// As HTML. Rows are those of what the report has: without motion none of motion, and a figure is explained if it is there.
std::string guide_to_numbers(const ReportContent& content);

}  // namespace whine
