// The numbers of a report in groups, at rest, by ring-down, in motion: of the whole, of each mesh, of each body, at each torque.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

struct ReportNumber {
  enum class Of { whole, mesh, body, mode };
  std::string group;  // heading of its table
  double torque;      // N m: torque_of()
  std::string quantity, unit, value;
  std::string remark = "";
  std::string way = "";    // end of `quantity` that says the direction of the sweep: ", speed rising"
  std::string rpm = "";    // of mesh frequencies: the same as the rotation of the driver
  std::string error = "";  // of `value`, in its unit; "": not known
  std::string part = "";   // mesh of several, body, mode, meshes of planets
  Of of = Of::whole;
  size_t column = 0;  // of the tables of its kind: number of the torque and, within it, of the mesh or body
};

inline constexpr const char* kBeyond = "beyond the backlash";  // remark on numbers that are not to be trusted

// In the order of the torques, then of natural modes.
std::vector<ReportNumber> report_numbers(const ReportContent& c);

// As tables of HTML, one for each group: a row for each quantity in the order in which they come, with both directions of the sweep. Of the
// whole, of meshes and of bodies apart; those of a pair's one mesh with those of the whole.
std::string results_tables(const ReportContent& c);

// In words: the largest vibration of the sweeps and how long teeth are apart; "" without sweeps.
std::string motion_words(const ReportContent& c);

}  // namespace whine
