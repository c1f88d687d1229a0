// The tables of a report, and its list of remarks, as HTML.
#pragma once
#include "report/report_content.h"

namespace whine {

std::string gears_table(const ReportContent& c);
std::string stiffness_tables(const ReportContent& c);
std::string natural_frequencies_table(const ReportContent& c);
std::string budget_table(const ErrorBudgetResult& b);
// Values of driver and driven gear side by side, of what is no gear's in the first column.
std::string parameters_table(const ReportContent& c);
std::string remarks_list(const ReportContent& c);

}  // namespace whine
