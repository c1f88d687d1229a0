// What P2000 prints, claim by claim, and how each is read from what a scene answers.
//
// A claim is data: where it is printed, what it says, which tolerance or criterion decides and why, and one function that
// reads its value.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "paper/answers.h"

namespace whine {

struct Finding {
  // In the unit of the claim; yes and no: 1 and 0; NaN: the state that the claim is about does not exist.
  double value;
  std::string note;  // numbers behind the value, or why there is none
  std::string reading =
      {};  // of a number that the text lets one read in several ways: the one that `value` is
};

enum class Scale {
  number,       // agrees within a tolerance
  statement,    // yes or no, by a criterion
  choice,       // how P2000 computes: given if the scene does so, too, else incomparable
  misprint,     // P2000's own numbers contradict it
  incomparable  // nothing of ours can stand against it
};

inline constexpr const char *kPaperScene = "parker2000", *kCalibratedScene = "parker2000-calibrated";

struct Claim {
  std::string id, place, text;  // place: section, table or figure of P2000
  Scale scale;
  std::string unit;  // "1" for a pure number, "yes/no" for a statement
  double printed;    // in the unit; 1 for a statement; NaN where the text has no number
  double tolerance;  // in the unit, inclusive; 0 for a statement
  std::string
      basis;  // why this tolerance or criterion; when the answer is yes; why there is nothing to compare
  std::function<Finding(const SceneAnswers&)> find;
  bool given = false;  // an input that scenes take over from P2000
};

// In the order of P2000.
const std::vector<Claim>& paper_claims();

// A number as findings show it; whole numbers stay whole.
std::string digits(double value, int count = 4);

}  // namespace whine
