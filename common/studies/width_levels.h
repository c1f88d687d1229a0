// What the next model level over the face width would change in a pair at rest.
#pragma once
#include <string>

#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

// Of a result beside that of another level, relative to the latter.
struct WidthChange {
  std::string level, other;        // "slices", "bodies in three dimensions, degree 8"
  double transmission_error = 0;   // largest over the phases, over its mean
  double peak_to_peak = 0;         // of the transmission error
  double first_harmonic = 0;       // of it
  double mean_stiffness = 0;       // secant
  double load_factor[2] = {1, 1};  // K_Hbeta of both
};

WidthChange width_change(const StaticResult& result, const StaticResult& other);

// The level that `result` is compared with: of one slice and of slices bodies in three dimensions, whose tables are computed here where the
// bodies have none, with the degree that their width asks for; of bodies in three dimensions two degrees less, whose difference is the error of
// the degree. Throws Error(input) for bodies in plane stress, and as static_transmission().
StaticResult next_width_level(const ReducedBody& driver, const ReducedBody& driven,
                              const StaticParameters& settings, const StaticResult& result);

}  // namespace whine
