#include "base/memory.h"

#include "base/tool.h"

namespace whine {

void log_memory(const std::string& what, double bytes) {
  constexpr double kGB = 1e9, kWorthALine = kGB;
  if (bytes >= kWorthALine) log_line(what, " take ", bytes / kGB, " GB of memory");
}

}  // namespace whine
