// Both gears of a pair at rest in one mesh position: where their teeth touch, how they are deformed and stressed.
#pragma once
#include "signal/static_result.h"
#include "solid/reduced_body.h"
#include "solid/sector_mesh.h"
#include "system/loaded_result.h"
#include "system/statics.h"

namespace whine {

// The contact of `statics` at a mesh phase of a mesh period, solved again on strips, and the whole fields that belong to its
// forces, with /VTKHDF's grid of both gears. A force acts along the normal of each gear's own flank: where a tip edge touches,
// off the line of action, contact_torque is therefore by some per cent of that pair's share more than the torque. Throws as
// contact_zones and loaded_gear.
LoadedArtifact loaded_pair(const MeshArtifact& driver_mesh, const MeshArtifact& driven_mesh,
                           const BodyArtifact& driver, const BodyArtifact& driven,
                           const StaticArtifact& statics, double phase, int period);

}  // namespace whine
