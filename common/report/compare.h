// Designs side by side as one page and one table: first what differs, in the scenes and in the results, then common figures.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

struct Design {
  std::string name;  // of its scene
  ReportContent content = {};
};

// A row of the table: the values of one quantity of one part, and by how much those of the other designs are above the first in per
// cent, where both are numbers. part: of pairs the torque in N m, of designs among which a train is the mesh or body; "": of the whole.
struct Difference {
  std::string part, quantity, unit;
  std::vector<std::string> value;   // of each design, "–" where it has none
  std::vector<std::string> change;  // of each design but the first, "" where it is no number
};

// Quantities that are not the same in all designs, of pairs at torques that all have. Trains, and pairs beside them, are compared
// each at its first torque: the one mesh of a pair with each mesh.
// Throws Error(input) for fewer than two designs, no common torque, and rigid gears.
std::vector<Difference> differences(const std::vector<Design>& designs);

// Keys of the scenes whose values differ; torque is empty, values of driver and driven gear are joined by " / ".
std::vector<Difference> scene_differences(const std::vector<Design>& designs);

// As report_html and report_tsv. pictures: of gear-plot, "compare-rest" and "compare-motion".
std::string compare_html(const std::vector<Design>& designs, const std::vector<ReportPicture>& pictures);
std::string compare_tsv(const std::vector<Design>& designs);

}  // namespace whine
