// Bodies in another discretisation, and how refinements are called.
#pragma once
#include <cmath>
#include <string>

#include "base/error.h"
#include "results/reduced_body.h"
#include "solid/mesher.h"
#include "solid/reduce.h"

namespace whine {

// The gear of a body, meshed and reduced with another discretisation; modes: as reduce() takes them. Errors as of make_sector_mesh(), reduce().
inline ReducedBody reduced_again(const ReducedBody& body, const BodyDiscretisation& with, int modes) {
  return reduce(make_sector_mesh(body.design, with), body.material, modes);
}

// "strips 8 to 16": what was refined, from which value to which.
inline std::string from_to(const char* name, double from, double to, const char* unit = "") {
  return text(name, " ", from, " to ", to, unit);
}

// A length (m) in mm, to three digits.
inline double shown_length(double length) {
  const double unit = std::pow(10, std::floor(std::log10(length * 1e3)) - 2);
  return std::round(length * 1e3 / unit) * unit;
}

}  // namespace whine
