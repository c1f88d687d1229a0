// k(t) of Eq. 23 from the static mesh stiffness over a mesh period, as springs that are constant in cells of the period.
//
// Cells make the motion exact; what they leave out is k(t) within a cell. For N cells that carry the means of the curve
// the error of the response falls with 1 / N^2.
#pragma once
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

// Other levels (N m-1) and another share of the high one, about the middle of the statics' own wave. Error(input) unless both
// are so stiff that the static load bends them by less than a module, the second, of more pairs, is not below the first, and
// the share lies in (0, 1).
RectangularWave stated_wave(const StaticResult& pair, double fewer, double more, double duty);

// Cells and springs only; mass and damper are left at 0. One spring without a gap for the whole mesh:
LumpedParameters cells_of(const RectangularWave& wave);
// values: (phase) N m-1 at equally spaced phases from 0; each of `cells` cells, the first about phase 0, carries the mean of
// the curve that is linear between them. unloaded: (phase) m, transmission error at which the spring touches, taken likewise;
// empty: 0. Error(input) for values not above 0.
LumpedParameters cells_of(const Eigen::VectorXd& values, int cells, const Eigen::VectorXd& unloaded = {});

// A spring per tooth pair, those off the line of action included, but for what the corner rule leaves out. Gap: from the
// flanks' geometry amid each cell; for a pair that is not loaded at rest the static transmission error at least.
// Stiffness: static load over deflection beyond the gap, carried on unchanged to phases at which the pair is not loaded at
// rest. With as many cells as static positions the springs at rest have the static transmission error; what loads change
// in each other's deflection is not in it. numbers: of the pairs, filled.
//
// chords 0: springs are linear. Otherwise each pair's force follows Hertz's law of a line contact inside a flank through its
// static point, as a polygon of that many chords (2 or more): half of them reach up to the static load, half from it to four
// times T / r. A pair has one spring per chord, and `numbers` repeats the pair once per chord. Error(input) if no pair carries
// load, for 1 chord or fewer than 0.
LumpedParameters cells_of_pairs(const StaticResult& pair, int cells, Eigen::VectorXi& numbers,
                                int chords = 0);

// m: deflection under `load` (N, not below 0) of a pair that deflects static_load / stiffness at its static load. Hertz's
// half-width a grows as sqrt(F), the surfaces sink by C F (ln(1 / a) + constants), C in m N-1 of both surfaces (Johnson,
// Contact Mechanics, 1985, sections 4.2(c) and 5.6; HalfPlaneSurface::coefficient), so only the ratio of the loads stays:
//   F (1 / stiffness + C / 2 ln(static_load / F)).
double hertz_deflection(double load, double static_load, double stiffness, double coefficient);

}  // namespace whine
