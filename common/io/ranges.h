// Ranges of numbers in artifacts, in SI: what a reader accepts. Each dataset names its own in its codec (io/codec.h);
// parameters that are keys of a scene have theirs in the lists of keys (model/keys.h). Ranges are wide: they keep out what no
// computation of this program writes, and what would index beyond an array, overflow or never end.
//
// Private to the layer io/.
#pragma once
#include <limits>
#include <string>

namespace whine {

struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool open = false;  // least itself is not allowed
};

// "" or why a value is not within the range, in words that follow the name of the dataset. A value that is not a number is
// outside.
std::string outside(const Range& range, double value);

namespace ranges {

inline constexpr double kMetres = 10, kNewtons = 1e12, kStiffnesses = 1e15, kHertz = 1e9, kNewtonMetres = 1e7,
                        kJoules = 1e12, kPascals = 1e15, kKilograms = 1e9, kAny = 1e30;
inline constexpr Range kLength{-kMetres, kMetres}, kSize{0, kMetres}, kRadius{1e-6, kMetres},
    kPlace{-1000, 1000},                                                               // m
    kForce{-kNewtons, kNewtons}, kLoad{0, kNewtons},                                   // N
    kSpring{-kStiffnesses, kStiffnesses}, kStiff{0, kStiffnesses},                     // N m-1
    kStressPerForce{-1e12, 1e12},                                                      // Pa N-1
    kFlexibility{-1, 1},                                                               // m N-1
    kFrequency{0, kHertz}, kSpeed{0, kHertz, true},                                    // Hz
    kMoment{-kNewtonMetres, kNewtonMetres}, kDrive{0, kNewtonMetres, true},            // N m
    kEnergy{-kJoules, kJoules}, kPressure{0, kPascals}, kStress{-kPascals, kPascals},  // J, Pa
    kTime{0, 1e6}, kMass{0, kKilograms, true}, kRoll{-10, 10},                         // s, kg or kg m2, rad
    kSigned{-1e6, 1e6}, kPositive{0, 1e6}, kShare{0, 1}, kMode{-1e6, 1e6}, kMultiplier{-1e12, 1e12},
    kImbalance{0, 1e12},  // of what should be small to what is there
    kNumber{0, 1 << 30}, kPhase{0, 1 << 30}, kFlag{0, 1}, kPair{-1000, 1000}, kTooth{0, 2000},
    kPeriods{1, 1 << 22}, kMultiple{0, 1 << 22}, kQuantity{-kAny, kAny};

}  // namespace ranges
}  // namespace whine
