// Figures of gears as they are drawn: mesh, contact zone, flanks.
#pragma once
#include "report/figures.h"
#include "results/sector_grid.h"
#include "results/static.h"

namespace whine {

// The whole pair and a close-up of the teeth in mesh, edges of elements in mm. Driver's centre at the origin,
// driven gear's above it at the centre distance, both unloaded and turned to mesh phase 0: the reference pair
// touches at the pitch point. Throws Error(input) if the meshes are not those of the static artifact's gears.
Figure mesh_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& pair);

// The contact zone of the reference pair at mesh phase 0: the teeth with the region in which the half-plane joins the finite
// elements, the candidate zone of strips with a candidate pair of points in the middle of each (P on the driver, G on the
// driven gear) on the unloaded flanks, and pressure and separation under load. Lengths along the flank grow to the driver's
// tip. Throws Error(input) as mesh_figure, and for statics without that contact.
Figure contact_zone_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& pair);

// What is taken off the driving flanks of both gears, as an inspection sheet shows it: material against the roll angle, the
// tip to the right, the designed involute a straight line, plus upwards. Marks: start of the active profile, lowest and
// highest point of single-pair contact, pitch point, tip.
Figure profile_figure(const StaticResult& pair);

}  // namespace whine
