// Displacements of nodes of a gear's teeth under forces on its driving flanks, its hub held: by the same split as loaded_gear.h.
#pragma once
#include "results/tooth_bending.h"

namespace whine {

// Each force is spread evenly over a tenth of a module. contact_width: m, on which the mesh meets.
ToothBending tooth_bending(const SectorGrid& mesh, const Material& material, double contact_width,
                           const std::vector<int>& nodes);

}  // namespace whine
