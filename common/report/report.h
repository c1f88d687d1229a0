// The report of a scene: what its artifacts and figures say, as one HTML page that needs nothing beside it, neither network nor
// script, and the same numbers as a table. The page is made of what is there: sections without content are left out.
#pragma once
#include "report/report_content.h"

namespace whine {

// Throws Error(input) for content without statics, of two pairs, or with a figure that is not known or given twice.
std::string report_html(const ReportContent& content);

// Columns torque [N m], quantity, value, unit, remark: geometry of the pair, which has no torque, then the numbers of the
// page's first table. A '#' line with the scene before the line of names.
std::string report_tsv(const ReportContent& content);

}  // namespace whine
