// What P2000 prints, claim by claim, beside the value of a scene that each is compared with.
//
// A claim is data of data/published/claims.toml: where it is printed, what it says, which tolerance or criterion decides and
// why. It names its value; paper/claim_values.h says how values are read from a scene's results.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "io/printed_claims.h"
#include "paper/results.h"

namespace whine {

struct Finding {
  // In the unit of the claim; yes and no: 1 and 0; NaN: the state that the claim is about does not exist.
  double value;
  std::string note;  // numbers behind the value, or why there is none
  std::string reading =
      {};  // of a number that the text lets one read in several ways: the one that `value` is
};

// The value of the claims that are Table 1.
inline constexpr const char* kNaturalFrequency = "natural-frequency";

struct Claim : PrintedClaim {
  std::function<Finding(const SceneResults&)> find;
};

// In the order of the file. Throws Error(input), with file:line, as read_printed_claims; for a value that is not known; for a
// torque, mesh frequency, order or contact that the value needs and that is missing, or that it does not need.
std::vector<Claim> read_claims(const std::string& path);

// A number as findings show it; whole numbers stay whole.
std::string digits(double value, int count = 4);

}  // namespace whine
