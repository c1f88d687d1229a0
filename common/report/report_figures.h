// The figures of a report and what is said under each.
#pragma once
#include "report/report_content.h"

namespace whine {

// Names of the figures that a report knows how to explain, in its order.
std::vector<std::string> report_figures();

// The pictures of a section of the report ("gears", "rest", "motion", "errors") with their captions, as HTML, in the order of
// report_figures().
std::string figures_of(const ReportContent& c, const std::string& section);

}  // namespace whine
