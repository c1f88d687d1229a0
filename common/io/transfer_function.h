// A transfer function from a text file with commas: a first line with the names frequency_Hz, magnitude, phase_deg in any order,
// then a row for each frequency; lines that begin with # are remarks.
#pragma once
#include <string>

#include "signal/sound.h"

namespace whine {

// Throws Error(io) if the file cannot be read, Error(input) with file:line for a column that is missing or unknown, a row of other
// length, a word that is no number, frequencies that do not ascend, a frequency outside of 0 to 1e9 Hz, a magnitude outside of 0 to
// 1e30, a phase beyond 1e9 degrees.
TransferFunction read_transfer_function(const std::string& path);

}  // namespace whine
