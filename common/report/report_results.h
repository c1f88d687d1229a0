// The numbers of a report in groups, at rest, by ring-down, in motion: a column for each torque of a pair, for each mesh of a train.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

struct ReportNumber {
  std::string group;  // heading of its table
  double torque;      // N m, of a train on the driving gear of the mesh
  std::string quantity, unit, value;
  std::string remark = "";
  std::string way = "";    // end of `quantity` that says the direction of the sweep: ", speed rising"
  std::string rpm = "";    // of mesh frequencies: the same as the rotation of the driver
  size_t column = 0;       // which torque, which mesh
  std::string error = "";  // of `value`, in its unit; "": not known
};

// What one mesh at rest says: excitation, loads, stress, losses; with the errors of the budget (nullptr: none).
std::vector<ReportNumber> mesh_at_rest(const StaticResult& s, size_t column,
                                       const ErrorBudgetResult* budget = nullptr);

// In the order of the torques.
std::vector<ReportNumber> report_numbers(const ReportContent& c);

// As tables of HTML, one for each group: a row for each quantity in the order in which they come, with both directions of the sweep.
std::string results_tables(const std::vector<ReportNumber>& results, const std::vector<std::string>& columns);
// The same of all torques of a pair, under words on what they are.
std::string results_tables(const ReportContent& c);

}  // namespace whine
