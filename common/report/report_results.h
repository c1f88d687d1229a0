// The numbers of a report by torque, in groups: at rest, by ring-down, in motion.
#pragma once
#include "report/report_content.h"

namespace whine {

struct ReportNumber {
  std::string group;  // heading of its table
  double torque;      // N m
  std::string quantity, unit, value;
  std::string remark = "";
  std::string way = "";  // end of `quantity` that says the direction of the sweep: ", speed rising"
  std::string rpm = "";  // of mesh frequencies: the same as the rotation of the driver
};

// In the order of the torques.
std::vector<ReportNumber> report_numbers(const ReportContent& c);

// As tables of HTML, one for each group: a row for each quantity in the order in which they come, with both directions of the sweep, a
// column for each torque.
std::string results_tables(const ReportContent& c);

}  // namespace whine
