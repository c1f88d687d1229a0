// What the teeth of a pair or of a train suffer, on one page: root stress, flank pressure, dynamic factors, losses, beside ISO 6336.
#pragma once
#include "report/report_content.h"
#include "report/stiffness_table.h"

namespace whine {

// Of the first torque, in the order in which they stand on the page: at rest, of a train for each [[mesh]] of the mesh with the largest root
// stress, then in motion, of a train where it moves. Throws Error(input) as require_one_scene(), without static.h5, for bodies without root
// stress and cracked teeth, and of a pair without sweeps up and down at its torque.
std::vector<WordTable> teeth_tables(const ReportContent& c);

// The page, with the figures root-stress, root-stress-branches, flank-pressure, load-sharing, tooth-loads and error-budget of those
// that are given.
std::string teeth_html(const ReportContent& c);

}  // namespace whine
