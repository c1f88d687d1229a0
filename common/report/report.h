// The report of a scene: what its artifacts and figures say, as one HTML page that needs nothing beside it, neither network nor
// script, and the same numbers as a table. The page is made of what is there: sections without content are left out.
#pragma once
#include "report/report_content.h"

namespace whine {

// Throws Error(input) as require_one_scene(), or for a figure that is not known or given twice.
std::string report_html(const ReportContent& content);

// Columns torque [N m], part (a mesh of several, a body, a mode), quantity, value, unit, remark, error: geometry of each [[mesh]], which has
// no torque, then the numbers of the page's tables of results. A '#' line with the scene before the line of names.
std::string report_tsv(const ReportContent& content);

}  // namespace whine
