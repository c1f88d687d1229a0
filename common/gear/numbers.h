// Numbers in messages: as many digits as a drawing has.
#pragma once
#include <cstdio>
#include <string>

namespace whine {

// 6 digits: 0.07125, 149.2.
inline std::string shown_number(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

// "3.5 mm" of 0.0035.
inline std::string millimetres(double metres) {
  return shown_number(metres * 1e3) + " mm";
}

}  // namespace whine
