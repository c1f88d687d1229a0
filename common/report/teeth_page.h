// What the teeth of a pair or of a train suffer, on one page: root stress, flank pressure, dynamic factors, losses, beside ISO 6336.
#pragma once
#include "report/report_content.h"
#include "report/stiffness_table.h"
#include "report/system_report.h"

namespace whine {

// Of the first torque, in the order in which they stand on the page: at rest, then in motion.
std::vector<WordTable> teeth_tables(const ReportContent& c);

// The page, with the figures root-stress, root-stress-branches, flank-pressure, load-sharing, tooth-loads and error-budget of those
// that are given. Throws Error(input) without static.h5, without sweeps up and down at its torque, for cracked teeth and as
// report_html().
std::string teeth_html(const ReportContent& c);

// Of a train: of each [[mesh]] the mesh with the largest root stress at rest, beside ISO 6336; of scenes with speeds forces of all meshes
// in motion. Throws Error(input) without static.h5 and modes.h5 and for bodies without root stress.
std::vector<WordTable> teeth_tables(const SystemReport& r);
std::string teeth_html(const SystemReport& r);

}  // namespace whine
