// Results of a stage as custom attributes of a REXS model: a copy of the file in its own form (XML, JSON or zip archive), in which
// the component of the stage has attributes more, whose ids begin with `custom_whine_`.
//
// JSON outside of the attributes of the stage and the other entries of an archive stay byte for byte. XML is written anew from what
// was parsed: elements, attributes, texts and comments stay, with their order; line ends, quotation marks, blanks within tags,
// character references and empty elements may be spelt otherwise, and the encoding becomes UTF-8.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace whine {

// Attributes that begin like this are results; an import passes them over.
inline constexpr const char* kRexsResult = "custom_whine_";

struct RexsResult {
  std::string name;            // without kRexsResult: lower case, digits, _
  std::string unit;            // a unit of REXS: "mum", "N / (mm mum)", "none"
  std::vector<double> values;  // one, or a list
  bool list = false;           // a list, also of one value: one for each torque
  std::string word = {};       // in place of values
};

// What tells the pair that results are of from another one.
struct RexsPair {
  std::array<int, 2> teeth;
  std::array<double, 2> module;                         // m
  double centre_distance;                               // m
  std::array<double, 2> pressure_angle, profile_shift;  // rad, in modules
};

// bytes: of the file at `path`, which stands in messages; stage: as of scene_of_rexs. Results that the stage has already are
// replaced. Values have nine digits. Throws Error(input) for what read_rexs and scene_of_rexs reject, and for a stage of other
// teeth, module, centre distance, pressure angle or profile shift than the pair, for XML of an encoding that is not converted
// (neither UTF-8 nor ISO 8859-1, with characters beyond ASCII) and for XML that defines entities.
std::string with_results(const std::string& path, const std::string& bytes, const std::string& stage,
                         const RexsPair& pair, const std::vector<RexsResult>& results);

// Whether a model holds results of a stage.
bool holds_results(const std::string& path);

}  // namespace whine
