#include "base/error.h"

#include <sstream>

namespace whine {

std::string text_of(std::initializer_list<TextPart> parts) {
  std::ostringstream out;
  out.precision(10);
  for (const TextPart& part : parts) out << part;
  return out.str();
}

}  // namespace whine
