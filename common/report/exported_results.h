// The results of a report as attributes of a REXS model: one value, or one for each torque.
#pragma once
#include "io/rexs/results.h"
#include "report/report_content.h"

namespace whine {

// Attributes without a torque: version, scene, contact_ratio. `torque` (N m) holds the torques; every list has a value for each of
// them, in its order. What is not there at every torque is left out. Jumps, of which a torque has any number, come with a list
// of the torques at which they are. Where speeds_beyond_backlash is not 0 back flanks would touch, which is not modelled: largest
// values may be of such a speed.
std::vector<RexsResult> exported_results(const ReportContent& content);

RexsPair exported_pair(const ReportContent& content);

}  // namespace whine
