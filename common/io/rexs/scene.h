// A scene from one stage of a REXS model, a cylindrical stage or a planetary one: every value with its origin in a comment, what the
// model does not say named and assumed, what it says and a scene cannot hold listed.
#pragma once
#include <string>
#include <vector>

#include "io/rexs/rexs.h"

namespace whine {

struct RexsScene {
  std::string text;   // TOML
  std::string stage;  // what was taken, in words
  std::vector<std::string> assumed, ignored;
};

// stage: id or name of a cylindrical_stage, which gives a pair, or of a planetary_stage, which gives a system; empty: the only one,
// where the meshes of a planetary_stage do not count. Such a mesh gives a pair with its share of the torque and its speed against the
// carrier. load_case: counts from 1; a model without any has none to choose. Throws Error(input), with component and attribute, for no
// or several stages, helical gears of planetary stages, helices that do not mesh, flanks that differ in pressure angle or profile shift, a number that is none or has an unknown
// unit, and what a gear cannot do without: teeth, module, pressure angle, face width, centre distance or positions.
RexsScene scene_of_rexs(const RexsModel& model, const std::string& stage, int load_case);

}  // namespace whine
