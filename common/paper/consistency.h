// Which of P2000's claims hold together in one reading, and which never do.
#pragma once
#include <string>
#include <vector>

#include "io/artifacts.h"
#include "io/claim_sets.h"
#include "io/readings.h"
#include "io/readings_result.h"

namespace whine {

struct SetFound {
  ClaimSet set;
  int readings = 0;    // in which all claims of one alternative hold
  size_t closest = 0;  // reading with the fewest failing claims; of those the one that agrees most
  int size = 0;        // claims of the alternative that is nearest there
  std::vector<std::string> failing;  // its claims that fail there
};

// Claims that hold in readings each, and in none together.
struct Conflict {
  std::string one, other;
  int with_one = 0, with_other = 0;  // readings
};

struct Consistency {
  std::vector<size_t> order;       // readings, those with the most agreeing claims first
  std::vector<int> agreeing;       // (reading)
  std::vector<std::string> never;  // claims that could agree and do so in no reading
  std::vector<SetFound> sets;
  std::vector<Conflict> conflicts;  // of claims that hold in a tenth of the readings each, most often first
};

// A claim holds if its verdict is agrees, given or fitted. Throws Error(input) for a set that names an unknown claim, or no
// readings.
Consistency consistency(const ReadingsResult& readings, const std::vector<ClaimSet>& sets);

// "dedendum 1.4, rack tip 0.32, bore 46 mm, corner contact to 0.5 deg, ...": one line.
std::string words_of(const Reading& reading);

// data/published/claim_sets.tsv: a line for each set; comments name the claims that no reading satisfies and the pairs that never meet.
std::string claim_sets_tsv(const ReadingsResult& readings, const Consistency& found);

// data/published/best_readings.tsv: the readings that were looked at again with strips, those with the most agreeing claims first.
std::string confirmed_tsv(const ReadingsResult& confirmed);

// A line for each reading, best first: what it fixes, how many claims agree, the verdict on each.
std::string readings_tsv(const ReadingsResult& readings, const Consistency& found);

}  // namespace whine
