// One tooth sector as a structured mesh of quadrilaterals, exact on every boundary.
//
// The half sector left of the tooth's centre line is cut into six four-sided blocks, which gmsh fills by
// transfinite interpolation; the other half is its mirror image. Afterwards each boundary node is put on its
// exact curve (involute, trochoid, circle, sector edge), because the splines that gmsh meshes lie micrometres
// off. Nine-node elements get mid-side nodes on the same exact curves and centre nodes from the transfinite
// map of the eight others. Elements are finest at the tip corner, where the stress of a load near the edge is
// steepest. The sector of an internal gear is the same with its tips inside and its rim outside.
#pragma once
#include "results/sector_grid.h"

namespace whine {

// With the sector of the cracked tooth where the design has a crack (solid/crack.h).
// root_element: m, size of the elements on the root where that is below element_size; 0: element_size.
// Throws Error(input) for an element size or order that cannot be used, Error(numerical) when the mesh does
// not keep its promises: positive Jacobian everywhere, sector edges that are images of each other, area of
// the exact sector.
SectorGrid make_sector_mesh(const GearDesign& design, const BodyDiscretisation& discretisation,
                            double root_element = 0);

// The checks alone, for a mesh from anywhere; same errors.
void check_sector_mesh(const SectorGrid& mesh);

// m2: area of the exact sector, by quadrature of its boundary curves.
double exact_sector_area(const GearDesign& design);

}  // namespace whine
