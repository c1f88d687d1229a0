#include "base/error.h"

#include <sstream>

namespace whine {

std::string joined(std::initializer_list<Part> parts) {
  std::ostringstream out;
  out.precision(10);
  for (const Part& part : parts) out << part;
  return out.str();
}

}  // namespace whine
