// Sets of claims that are looked for together in one reading, from a table in TOML (data/published/claim_sets.toml).
#pragma once
#include <string>
#include <vector>

namespace whine {

// A set holds where one of its alternatives holds: all claims of that list.
struct ClaimSet {
  std::string name, says;
  std::vector<std::vector<std::string>> alternatives;
};

// Error(input) names file:line: unknown keys, a set without claims, a name in `with` that no earlier set has.
std::vector<ClaimSet> read_claim_sets(const std::string& path);

}  // namespace whine
