// What carries the outside of a ring: a housing as good as rigid, to which the nodes there are fixed, or an even elastic support.
//
// The support is a layer of springs between the outside of the rim and the rigid housing, k_r along the radius and k_t across it
// per length of circumference (N m-1 each m), as in models of ring gears (Wu and Parker, Vibration of rings on a general elastic
// foundation, J. Sound Vib. 295 (2006)). It adds
//   K = integral of N^T (k_r e_r e_r^T + k_t e_t e_t^T) N ds
// over the outside. It is alike all round, so the ring keeps its cyclic symmetry; supports at single places, lugs, would not. Per
// displacement of the rim as a whole: 2 pi r^3 k_t to turn it (N m), pi r (k_r + k_t) to move it (N m-1).
#pragma once
#include "results/sector_grid.h"
#include "solid/elements.h"

namespace whine {

// Adds K of one sector, (2 node, 2 node) N m-1; nothing for a gear that is rigid where it is held. Throws Error(input) if the
// nodes on the outside do not make whole element sides.
void add_rim_support(const SectorGrid& mesh, SparseReal& stiffness);

}  // namespace whine
