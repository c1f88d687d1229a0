#include "base/number_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/tool.h"

namespace whine {

std::vector<double> number_list(const std::string& name, const std::string& word) {
  if (word.empty()) return {};
  const bool range = word.find(':') != std::string::npos;
  std::vector<double> values;
  for (size_t at = 0; at <= word.size();) {
    const size_t end = std::min(word.find(range ? ':' : ',', at), word.size());
    values.push_back(number_option(name, word.substr(at, end - at)));
    at = end + 1;
  }
  if (!range) return values;
  if (values.size() != 3 || values[2] != std::floor(values[2]) || values[2] < 2 || values[2] > 10000)
    fail(Failure::usage, name, " is ", word, "; write from:to:count, as in 5:300:60, or numbers with commas");
  std::vector<double> out;
  out.reserve(static_cast<size_t>(values[2]));
  for (int i = 0; i < values[2]; ++i)
    out.push_back(values[0] + (values[1] - values[0]) * i / (values[2] - 1));
  return out;
}

}  // namespace whine
