// Which numbers of a scene were fitted, to which claims: a table in TOML that people keep beside the scenes.
//
//   [[fitted]]
//   scene = "parker2000"
//   number = "bore_radius_mm"
//   to = ["mean-stiffness"]     # claims that agree by construction; left out: chosen for how many claims agree in all
#pragma once
#include <string>
#include <vector>

namespace whine {

struct FittedNumber {
  std::string scene, number;
  std::vector<std::string> claims;  // empty: tied to no single claim
};

// Error(input) names file:line and key.
std::vector<FittedNumber> read_fitted_numbers(const std::string& path);

}  // namespace whine
