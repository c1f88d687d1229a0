// Options that are lists of numbers.
#pragma once
#include <string>
#include <vector>

namespace whine {

// "5:300:60": 60 numbers from 5 to 300; "5,10,20": these; "": none. Error(usage) names option and value.
std::vector<double> number_list(const std::string& name, const std::string& word);

}  // namespace whine
