// What the report of a system says of its sweeps: tables, numbers, remarks.
#pragma once
#include <string>
#include <vector>

#include "report/system_report.h"
#include "report/system_report_tables.h"

namespace whine {

// Of the sweeps, each mesh and each body the largest values over speed, and where; "" without sweeps. Dynamic factor: largest mesh
// force over the mean one at rest.
std::string motion_tables(const SystemReport& r);

// "largest RMS of the transmission error, speed rising" and others of each mesh and body; the remark says at which speed.
std::vector<SystemNumber> motion_numbers(const SystemReport& r);

// Contact loss, motions that do not repeat, energy that is not accounted for, speeds with two motions.
std::vector<Remark> motion_remarks(const SystemReport& r);

// In words, for the figure: largest vibration and contact loss.
std::string motion_words(const SystemReport& r);

// "800 to 950, 1200 Hz": speeds (Hz, ascending) that are marked; those without a gap in the list are joined.
std::string speeds_words(const Eigen::VectorXd& speeds, const std::vector<bool>& marked);

}  // namespace whine
