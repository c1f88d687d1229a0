// The list of all datasets of all artifacts, from the descriptions that writers and readers walk.
#pragma once
#include <string>

namespace whine {

// A line for each dataset outside of /parameters and /provenance: "<artifact>  <dataset> (<axes>; <unit>): <meaning>", and in
// brackets the equation that it comes from.
std::string dataset_list();

}  // namespace whine
