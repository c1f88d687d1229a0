// What ParaView shows of loaded gears, small enough to be handed on: whole elements where the teeth are loaded, their corners
// elsewhere.
#pragma once
#include "results/loaded.h"

namespace whine {

// Leaves nine-node cells only to the loaded teeth and `beside` teeth on either side; other cells keep their four corners, the
// rest of their row in vtk_cell is -1. Points that no cell and no line has any more go, values at the others stay as they are.
// Two-thirds of the points of a pair of 50 teeth go, none at which stresses change within an element.
void thin_view(LoadedResult& loaded, int beside = 1);

}  // namespace whine
