// The scorecard: what P2000 prints beside what scenes answer. Verdicts follow from value and tolerance alone.
#pragma once
#include <string>
#include <vector>

#include "plot/claims.h"

namespace whine {

enum class Verdict { agrees, differs, incomparable };
Verdict verdict(const Claim& claim, const Finding& finding);

struct ScoredClaim {
  Claim claim;
  std::vector<Finding> findings;  // (scene)
};
struct Scorecard {
  std::vector<std::string> scenes;
  std::vector<ScoredClaim> rows;
};
Scorecard score(const std::vector<Claim>& claims, const std::vector<SceneAnswers>& scenes);

// "<scene>: 40 agree, 30 differ, 20 cannot be compared", one for each scene.
std::vector<std::string> bottom_line(const Scorecard& card);

// sources: paths of the artifacts, named in comment lines.
std::string scorecard_tsv(const Scorecard& card, const std::vector<std::string>& sources);
// For the README: notes only where a verdict is not "agrees".
std::string scorecard_markdown(const Scorecard& card);
// For the terminal, in columns.
std::string scorecard_text(const Scorecard& card);
// id, place, text, printed value and tolerance of each claim, between bars as in the first columns of the README's table.
std::string claims_markdown(const std::vector<Claim>& claims);

}  // namespace whine
