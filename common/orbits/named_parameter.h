// How messages call a parameter of a map, and its values.
#pragma once
#include <string>

#include "base/format.h"

namespace whine {

struct NamedParameter {
  std::string name, unit;
  double factor = 1;  // from SI to the unit

  // "1613.56 Hz"
  std::string words(double value) const {
    return shown_number(factor * value) + (unit.empty() ? "" : " " + unit);
  }
};

}  // namespace whine
