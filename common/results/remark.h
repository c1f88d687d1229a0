// What a reader of a result has to know beside its numbers.
#pragma once
#include <sstream>
#include <string>

namespace whine {

// In words without a full stop.
struct Remark {
  bool warning = false;  // something is wrong or left out; else out of the ordinary only
  std::string words;
};

// Numbers with 6 digits, as log_line() writes them.
template <class... Parts>
Remark remark(bool warning, const Parts&... parts) {
  std::ostringstream words;
  (words << ... << parts);
  return {warning, words.str()};
}

}  // namespace whine
