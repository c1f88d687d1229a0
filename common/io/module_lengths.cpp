#include "io/module_lengths.h"

#include <cstdlib>
#include <string>
#include <variant>

namespace whine {

double length_of_module(const Key& key, double module) {
  const std::string start = "module / ", word(key.fallback ? key.fallback : "");
  return word.starts_with(start) ? module / std::strtod(word.c_str() + start.size(), nullptr) : 0;
}

void take_module(const KeyList& keys, double module) {
  for (const Key& key : keys) {
    const double length = length_of_module(key, module);
    if (!(length > 0)) continue;
    double& value = *std::get<double*>(key.slot);
    if (value == 0) value = length;
  }
}

}  // namespace whine
