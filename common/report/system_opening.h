// The first five lines of the report of a system, as far as its artifacts hold them.
#pragma once
#include <string>
#include <vector>

#include "report/speed_words.h"
#include "report/system_report.h"

namespace whine {

// Excitation, critical speeds, contact, dynamic factor, what to change; see opening.h. Meshes of one [[mesh]] are said together.
std::vector<std::string> opening_lines(const SystemReport& report);

// The member that is driven, whose rotation stands beside the mesh frequency: that of the largest torque that drives; of rigid gears the
// first one that turns.
TurningMember driving_member(const SystemReport& report);

}  // namespace whine
