// The only tolerance of numbers in tests: relative. doctest's Approx alone adds 1 to the size of what it compares, so
// metres, seconds and m/N, all far below 1, would agree whatever they are. Where the true value is zero there is no
// relative error: CHECK(std::abs(found) < ...) with the tolerance in the unit of the number.
#pragma once
#include <doctest/doctest.h>

// Equal to a number a if |a - expected| < tolerance * max(|a|, |expected|); never equal to 0.
inline doctest::Approx relative(double expected, double tolerance) {
  return doctest::Approx(expected).scale(0).epsilon(tolerance);
}
