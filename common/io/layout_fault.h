// What no system can be, of whoever wrote it.
//
// Private to the layer io/.
#pragma once
#include <optional>
#include <string>

#include "model/system.h"

namespace whine {

// In an item of a list ("body", "mesh", "drive"), from 0, by one of its keys.
struct LayoutFault {
  std::string list;
  size_t number;
  std::string key, value, allowed;
};
std::optional<LayoutFault> layout_fault(const System& layout);

}  // namespace whine
