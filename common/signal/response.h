// What a speed sweep says: the numbers of a frequency response, one row per speed.
//
// DTE = r1 theta1 + r2 theta2 on the line of action. dte_rms is the RMS of its oscillating part (the ordinate
// of the paper's Figs. 4-7), over the stored whole number of mesh periods, so that subharmonics count.
#pragma once
#include "files/schemas.h"

namespace whine {

inline constexpr int kResponseHarmonics = 10;

// Rows keep the order of marching. Harmonics are those of the mesh frequency, 10 or as many as the coarsest
// row resolves. Jumps are the sweep's own: it bisects them. Throws Error(input) for a sweep without speeds,
// arrays whose lengths disagree, values that are not finite, or negative forces.
ResponseArtifact response(const SweepArtifact& sweep);

// Hz: sqrt(k (r1^2/I1 + r2^2/I2)) / 2 pi with the sweep's mean secant stiffness k, base radii r and total
// inertias I. An estimate: the secant stiffness of the statics lies below the tangent one, the elastic body's
// inertia is spread.
double natural_frequency_estimate(const SweepArtifact& sweep);

}  // namespace whine
