// Whether motions are of one system: what a figure may set beside each other.
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"
#include "results/response.h"

namespace whine {

// Bodies by name and teeth, and the number of meshes.
bool one_system(const System& a, const System& b);

// Whether the sweep jumps between two speeds (Hz), across which its curve is not drawn.
bool jumps_between(const ResponseResult& sweep, double from, double to);
// "jumps: speed rising 2645 +- 0.4 Hz"; "" where none is known.
std::string jump_note(const std::vector<ResponseResult>& sweeps);

// What a figure needs for speeds in rpm: gears and carriers, or why they have none.
void add_shafts(const System& system, Figure& figure);
void add_shafts(const MotionSource& source, Figure& figure);

// Throws Error(input) unless all sweeps are of one pair or train, with one torque on each body and one damping, at most one of them in a
// direction. `source`: of what else stands in the figure, or of the first sweep; `what` it is, such as "the branch".
void require_one_system(const std::string& what, const MotionSource& source,
                        const std::vector<ResponseResult>& sweeps);

}  // namespace whine
