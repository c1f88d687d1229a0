// Whether the pressure of a mesh under load leaves an involute at its root, judged from the drawing before any body is computed. At rest
// side_at_root() judges the same of the pressure that is computed.
//
// Half-width by Hertz, a^2 = 2 R F C (C of both half-planes). F is not known before the bodies are: a pair has at least 1 / (2 n - 1) of
// the load at the ends of its path, n pairs sharing it, growing to twice that where the next pair comes or goes (the sharing of spur
// gears in ISO 6336), and at most all of it. Under the least force the pressure is moved away from the root by R times the slope to which
// the mate's tooth bends, k F / (E b m) with k = 17 for a load at its tip (10 of bending, 4 of shear, 3 of its foundation): a tenth of a
// half-width of steel, most of it of a mate of polymer. What the least force lets reach the root is rejected, what only the largest does
// is warned of; what passes both computes. A steel pinion of 25 teeth on a POM wheel of 60, module 1 mm, 10 mm wide, runs at rest up to
// 6 N m and further; without the slope it would be rejected from 2 N m on.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "gear/pair.h"
#include "model/scene.h"

namespace whine {

enum class ForceBound { least, largest };

// load: N along the line of action. "under ... the pressure reaches ..." with a remedy that even the largest force lets pass; "" if it does
// not reach.
std::string near_interference(const SceneGear& driver, const SceneGear& driven, const GearMeshSpec& mesh,
                              double load, ForceBound force);

// Of a pair under its largest torque, of the meshes of a train of elastic gears that is in balance: number of the [[mesh]] section and
// words.
std::vector<std::pair<size_t, std::string>> near_interferences(const Scene& scene, const System& layout,
                                                               ForceBound force);

}  // namespace whine
