// The numbers of a report by torque: at rest, by ring-down, in motion.
#pragma once
#include "report/report_content.h"

namespace whine {

struct ReportNumber {
  double torque;  // N m
  std::string quantity, unit, value;
  std::string remark = "";
};

// In the order of the torques.
std::vector<ReportNumber> report_numbers(const ReportContent& c);

// As a table of HTML: a row for each quantity in the order in which they come, a column for each torque.
std::string results_table(const ReportContent& c);

}  // namespace whine
