// Memory that a computation is about to take.
#pragma once
#include <string>

namespace whine {

// Says in a line on standard error that `bytes` are taken for `what`, if they are 1 GB or more.
void log_memory(const std::string& what, double bytes);

}  // namespace whine
