// A system of elastic gears at rest: what its meshes and bearings do over a mesh period.
#pragma once
#include "report/figures.h"
#include "system/system_static_result.h"

namespace whine {

// Transmission error and force of each mesh, size of the force on each bearing, pin and axis; the notes say how planets share
// the load.
Figure system_static_figure(const SystemStaticArtifact& a);

}  // namespace whine
