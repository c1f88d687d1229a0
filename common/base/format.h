// Numbers in messages: as many digits as a drawing has.
#pragma once
#include <cstdio>
#include <string>
#include <vector>

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

// "torques 100, 62.5 N m", the first eight.
inline std::string torques_in_words(const std::vector<double>& torques) {
  constexpr size_t kShown = 8;
  std::string out = torques.size() == 1 ? "torque " : "torques ";
  for (size_t i = 0; i < torques.size() && i < kShown; ++i)
    out += (i > 0 ? ", " : "") + shown_number(torques[i]);
  return out + (torques.size() > kShown ? ", ..." : "") + " N m";
}

}  // namespace whine
