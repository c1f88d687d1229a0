// Errors that differ from tooth to tooth.
#pragma once
#include <complex>
#include <numbers>
#include <vector>

#include "model/gear.h"

namespace whine {

inline ToothErrors pitch(int teeth, double all, double first = 0) {
  ToothErrors errors;
  errors.cumulative_pitch.assign(static_cast<size_t>(teeth), all);
  errors.cumulative_pitch[0] += first;
  return errors;
}

// Every kind of error.
inline ToothErrors mixed(int teeth) {
  constexpr double um = 1e-6;
  ToothErrors errors;
  for (int i = 0; i < teeth; ++i) {
    errors.cumulative_pitch.push_back(((i * 37) % 11 - 5) * um);
    errors.profile_slope.push_back(((i * 23) % 7 - 3) * um);
    errors.profile_form.push_back(((i * 17) % 5 - 2) * um);
  }
  errors.eccentricity = 4 * um;
  errors.eccentric_tooth = 3.5;
  return errors;
}

// m: the wave of one revolution of places around a gear, its amplitude times their number.
inline std::complex<double> wave_of(const std::vector<double>& places) {
  const auto number = static_cast<double>(places.size());
  std::complex<double> sum = 0;
  for (size_t i = 0; i < places.size(); ++i)
    sum += places[i] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / number);
  return sum;
}

}  // namespace whine
