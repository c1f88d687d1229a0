// Errors that differ from tooth to tooth.
#pragma once
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

}  // namespace whine
