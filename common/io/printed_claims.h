// What P2000 prints, claim by claim, from a table in TOML (data/published/claims.toml).
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace whine {

enum class Scale {
  number,       // agrees within a tolerance
  statement,    // yes or no, by a criterion
  choice,       // how P2000 computes: given if the scene does so, too, else incomparable
  misprint,     // P2000's own numbers contradict it
  incomparable  // nothing of ours can stand against it
};

struct PrintedClaim {
  std::string id, place, text;  // place: section, table or figure of P2000
  Scale scale = Scale::number;
  std::string unit;  // "1" for a pure number, "yes/no" for a statement
  double printed = std::numeric_limits<
      double>::quiet_NaN();  // in the unit; 1 for a statement; NaN where the text has no number
  double tolerance = 0;      // in the unit, inclusive; 0 for a statement
  std::string
      basis;  // why this tolerance or criterion; when the answer is yes; why there is nothing to compare
  bool given = false;  // an input that scenes take over from P2000

  std::string value;          // which value of a scene stands against it
  int torque = 0;             // N m, at which that value is taken; 0, "": it needs none
  double mesh_frequency = 0;  // Hz
  int order = 0;              // of a resonance or of a harmonic
  std::string contact;        // "one", "two" pairs of teeth, "mean" over the mesh period

  std::string where;  // file:line
};

// In the order of the file. Error(input) names file:line: unknown keys, a value of another type, a key that the kind of the
// claim needs and that is missing, or that it cannot have; two claims of one id.
std::vector<PrintedClaim> read_printed_claims(const std::string& path);

}  // namespace whine
