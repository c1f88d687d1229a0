// Numbers in messages: as many digits as a drawing has.
#pragma once
#include <algorithm>
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

// A number and its error, as they are told: no more digits than the error allows, at most `digits` significant ones.
struct ToldNumber {
  std::string value, error;

  std::string words() const { return error.empty() ? value : value + " ± " + error; }
};

// The error is rounded up, to one digit, or to two where it begins with 1; the value ends at the same decimal. An error below half of the
// value's last digit is told as one of that digit. 369.9770, 0.0131: "369.977 ± 0.014" (six digits), 1234, 87: "1230 ± 90". A negative
// error or one that is no number is none: the value with all of `digits`.
inline ToldNumber told(double value, double error, int digits) {
  const auto exponent = [](double x) {
    return x == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(x))));
  };
  const int most = digits - 1 - exponent(value);  // decimals, below 0: whole tens
  const bool known = error >= 0 && std::isfinite(error);
  int decimals = most;
  if (known && error > 0) {
    const int first = exponent(error);
    const bool begins_with_one = std::ceil(error * std::pow(10, 1 - first) * (1 - 1e-12)) < 20;
    decimals = std::min(most, begins_with_one ? 1 - first : -first);
  }
  const double unit = std::pow(10, -decimals);
  const auto rounded = [&](double x) { return fixed(x, std::max(decimals, 0)); };
  const std::string shown_value = rounded(decimals < 0 ? std::round(value / unit) * unit : value);
  if (!known) return {shown_value, ""};
  return {shown_value, rounded(std::max(1.0, std::ceil(error / unit * (1 - 1e-12))) * unit)};
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
