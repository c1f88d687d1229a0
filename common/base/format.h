// Numbers in messages: as many digits as a drawing has.
#pragma once
#include <cmath>
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

// %.<digits>g: text() would show ten digits.
inline std::string shown(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

// %.<decimals>f, without the sign of what rounds to 0.
inline std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  const std::string out = buffer;
  return std::signbit(value) && std::isfinite(value) && out.find_first_of("123456789") == std::string::npos
             ? out.substr(1)
             : out;
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
