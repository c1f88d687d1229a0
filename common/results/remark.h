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

// Pa: what flanks of hardened steel carry in the long run; the strongest go to 2 GPa.
inline constexpr double kHardenedSteelPressure = 1.5e9;
inline constexpr const char* kBeyondSteel =
    " GPa is above the 1.5 GPa that flanks of hardened steel carry in the long run (the strongest 2 GPa); the teeth are elastic here and know of no yielding: check the torque and the face width";

// Numbers with 6 digits, as log_line() writes them.
template <class... Parts>
Remark remark(bool warning, const Parts&... parts) {
  std::ostringstream words;
  (words << ... << parts);
  return {warning, words.str()};
}

}  // namespace whine
