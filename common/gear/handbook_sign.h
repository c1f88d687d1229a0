// The profile shift of an internal gear in the sign of handbooks that count it outwards, towards its roots; here it is that of ISO 21771,
// towards the tips.
#pragma once
#include <optional>
#include <string>

#include "model/gear.h"

namespace whine {

// Of a ring with a profile shift, the two gears of whose mesh do not fit at their centre distance (m): not at all, or with more
// backlash than their thinned teeth leave; the shift of the other sign, if they fit with it, at the same heights or the same diameters, or
// if these diameters make heights that gears have with it alone. The backlash of the two signs differs by 4 x m sin(alpha) about.
std::optional<double> shift_of_other_sign(const GearDesign& driver, const GearDesign& driven,
                                          double centre_distance);

// "profile_shift = 0.3 fits: ..." of such a shift.
std::string other_sign_words(double shift);

}  // namespace whine
