// Load over the flank of a pair in slices, as a contact pattern.
#pragma once
#include "report/figures.h"

namespace whine {

// Line load on a tooth over face and path of contact, as the tooth passes through the mesh, as colours; beside it the line load of each
// tooth pair over the face at mesh phase 0. Throws Error(input) for a pair in one slice.
Figure flank_load_figure(const StaticResult& statics);

}  // namespace whine
