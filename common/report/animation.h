// One mesh period of a steady motion, picture by picture: the teeth as they roll, bend and part.
#pragma once
#include "report/figures.h"
#include "results/sweep.h"
#include "results/tooth_bending.h"

namespace whine {

// Of the speed of `sweep` at mesh_frequency (Hz; 0: the one with the largest RMS), `frames` pictures evenly over the mesh
// periods in which it repeats. Blocks "<frame> driver", "<frame> driven": outlines near the mesh; "<frame> force": where and
// how strongly each pair presses; "history" and "contact lost": the whole period. Vibration and deflection are magnified by
// one factor, the number `magnified`: hubs turn by the transmission error, shared out as in free vibration; teeth bend as they
// would at rest under the loads of the moment, which `bending` finds (their own inertia left out). Gaps of pairs that are out
// of contact by less than the vibration are magnified alike, by teeth that lean. Back flanks are drawn drawn_back (mm) thinner,
// so that they stay apart: the model knows none. Throws Error(input) for meshes that are not of the sweep's gears, a lumped
// model, a frequency that is no speed of the sweep, teeth that differ, and fewer than 2 or more than 1000 frames.
Figure animation_figure(const SectorGrid& driver, const SectorGrid& driven, const SweepResult& sweep,
                        FindBending bending, double mesh_frequency, int frames);

}  // namespace whine
