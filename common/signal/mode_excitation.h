// Which orders of the mesh frequency excite a natural mode of a train.
#pragma once
#include <vector>

#include "results/modes.h"

namespace whine {

// What is left of the modal force where `meshes` have equal transmission errors: |sum a_m exp(2 pi i l phase_m)| over them, over
// sum |a_m| of all meshes, a_m the deflection of mesh m in the mode, l the order. 0: they cancel, as those of N equal planets at equal
// spacing about a gear of z teeth do unless l z is k or -k modulo N, the mode of planet harmonic k.
double excitation_left(const ModesResult& modes, Eigen::Index mode, int order,
                       const std::vector<size_t>& meshes);

}  // namespace whine
