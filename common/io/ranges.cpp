#include "io/ranges.h"

#include "base/error.h"

namespace whine {

std::string outside(const Range& range, double value) {
  if (value > range.least && value <= range.most) return "";
  if (value == range.least && !range.open) return "";
  return text("holds ", value, ", allowed is ", range.open ? "more than " : "", range.least, " to ",
              range.most);
}

}  // namespace whine
