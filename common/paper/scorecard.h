// The scorecard: what P2000 prints beside the results of scenes. Verdicts follow from value and tolerance alone.
#pragma once
#include <string>
#include <vector>

#include "io/fitted_numbers.h"
#include "paper/claims.h"

namespace whine {

enum class Verdict { agrees, differs, given, fitted, incomparable, misprint };
// given, fitted: agrees, but because the scene took it over or was fitted to it.
Verdict verdict(const Claim& claim, const Finding& finding, bool is_fitted);

struct ScoredClaim {
  Claim claim;
  std::vector<Finding> findings;  // (scene)
  // Artifacts that answer, below the scene's folder, as the shell would expand them: "T150/{up,down}/response.h5"
  std::string sources;
};
struct Scorecard {
  std::vector<std::string> scenes;
  std::vector<FittedNumber> fitted;
  std::vector<ScoredClaim> rows;
};
// Throws Error(input) for a number that is fitted to a claim that does not exist.
Scorecard score(const std::vector<Claim>& claims, const std::vector<SceneResults>& scenes,
                const std::vector<FittedNumber>& fitted);
Verdict verdict(const Scorecard& card, const ScoredClaim& row, size_t scene);

// "<scene>: 40 agree, 30 differ, 9 given or fitted, 20 cannot be compared, 1 misprint of P2000; 3 numbers fitted to 4 claims,
// 6 chosen for the number of claims that agree", one for each scene.
std::vector<std::string> bottom_line(const Scorecard& card);

// The published table, data/published/scorecard.tsv. sources: paths of the artifacts, named in comment lines.
std::string scorecard_tsv(const Scorecard& card, const std::vector<std::string>& sources);
// For the terminal: columns; below each claim its reason, where a verdict is not "agrees" or there are several readings, and the
// artifacts that answer.
std::string scorecard_text(const Scorecard& card);
// The first columns of the TSV: id, place, text, unit, printed value, tolerance, basis.
std::string claims_tsv(const std::vector<Claim>& claims);

}  // namespace whine
