// The list of all datasets of all artifacts, from the descriptions that writers and readers walk.
#pragma once
#include <string>

namespace whine {

// A Markdown table with a line for each kind of artifact: its datasets outside of /parameters and /provenance with axes and
// unit.
std::string dataset_table();

}  // namespace whine
