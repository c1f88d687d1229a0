// The largest contact pressure that a result may state, and where there is none.
//
// The pressure of a contact over a ridge of the flank (gear/flank_kink.h) or at a tip edge, which is sharp in this model, has
// no largest value: what strips show grows as they get finer. Elsewhere 8 strips are within 2.1 % of Hertz.
#pragma once
#include <vector>

#include "results/loaded.h"
#include "results/static.h"

namespace whine {

FlankPressure flank_pressure(const StaticResult& statics);

// What a report says of contact over a ridge; none if there is none.
std::vector<Remark> pressure_remarks(const StaticResult& statics);

struct LoadedPressure {
  double inside = 0;   // Pa: largest of the pairs that touch inside their flanks; 0: there are none
  double at_edge = 0;  // Pa: largest that strips show of a pair that touches at a tip edge; 0: there are none
  int edge_pair = 0;   // its number
  double edge_force = 0;  // N: that it carries
};
LoadedPressure largest_pressure(const LoadedResult& loaded);

}  // namespace whine
