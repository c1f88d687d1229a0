// Mathematical constants and factors between units, of which more than one source has need.
#pragma once
#include <numbers>

namespace whine {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2 * kPi;

inline constexpr double kOneDegree = kPi / 180;  // rad in a degree: a number of degrees times it is an angle
inline constexpr double kInDegrees = 180 / kPi;  // rad -> degrees

inline constexpr double kInMegapascals = 1e-6;  // Pa -> MPa

}  // namespace whine
