// What ParaView shows of natural modes: the gears of a system at their places, and how each mode moves them.
//
// A body moves as a rigid one: a point P by X + sense u / r k x (P - C), X and u of the mode's shape, C its axis, k out of the
// plane. A mode is scaled so that the largest displacement is a twentieth of half of the drawing's width.
#pragma once
#include <vector>

#include "model/gear.h"
#include "results/modes.h"

namespace whine {

inline constexpr double kShownMotion =
    0.05;  // largest displacement over half of the longer side of the drawing's box

// Fills modes.view; without gears it stays empty. design: [body] drawing of each gear; nullptr where it is not known, of carriers
// and rigid gears: of these the teeth are drawn with straight sides on the working pitch circle of their first mesh. Point data
// "mode_03_planet_1650.21_Hz"; cell data: number of the body, and 0 for a central gear, 1 for a planet, 2 for a carrier.
void add_mode_view(ModesResult& modes, const std::vector<const GearDesign*>& design);

}  // namespace whine
