// Both gears of a pair at rest in one mesh position: where their teeth touch, how they are deformed and stressed.
#pragma once
#include "results/loaded.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "system/statics.h"

namespace whine {

// The contact of `statics` at a mesh phase of a mesh period, solved again on strips, and the whole fields that belong to its
// forces, with /VTKHDF's grid of both gears. A force acts along the normal of each gear's own flank: where a tip edge touches,
// off the line of action, contact_torque is therefore by some per cent of that pair's share more than the torque. Throws as
// contact_zones and loaded_gear.
LoadedResult loaded_pair(const SectorGrid& driver_mesh, const SectorGrid& driven_mesh,
                         const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double phase, int period);

}  // namespace whine
