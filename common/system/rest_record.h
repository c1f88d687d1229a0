// A system at rest, position after position: its meshes (mesh_record.h), motions of its bodies, bearing forces and torques.
#pragma once
#include <vector>

#include "results/static.h"
#include "system/system.h"

namespace whine {

// section: [mesh] number of its [[mesh]], whose meshes share a load; of: [mesh] its drawings and settings, of one contact and discretisation;
// zone_factor: as in static_zones(). Fills meshes, bodies, certificate and margin of backlash. frozen: with mesh_stiffness, whose
// diagonal is then the tangent stiffness; a system of one mesh alone may do without. Left out: settings, names, efficiency,
// harmonics and remarks. Throws Error(input) for more positions than memory holds, and what over_period() throws.
SystemStaticResult record_rest(const SystemModel& system, const std::vector<int>& section,
                               const std::vector<GearPairParameters>& of, double zone_factor, bool frozen);

}  // namespace whine
