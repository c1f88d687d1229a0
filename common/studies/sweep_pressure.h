// Flank pressure over the flank and over speed, from the tooth loads of a sweep, by Hertz's law of a line.
//
//   p_H = sqrt(F E* / (pi b R)),   a = sqrt(4 F R / (pi b E*))
// F the load of a pair, b the face width, R the relative radius of curvature at the nominal touching point, E* of both materials
// in the plane state of the contact, a the half width. A pair passes each place of the flanks once in a mesh period; places are
// 1/64 of a mesh period wide. The load of a place is the least of the samples there (4 of 256 steps, 2 of 128), so that spikes of
// single samples, whose height depends on the time step, do not count; it differs by some per cent from loads held for 1/64 of a
// period wherever that begins (signal's held loads). With 64 steps or fewer it is a single sample.
//
// No pressure is stated where there is none: a tip edge is sharp in this model, and the pressure of an edge on a flank is
// singular. Of pairs that touch at a tip edge off the line of action, and of contacts that reach a tip edge (the half width
// is beyond its distance), the load is stated instead, by the gear whose edge it is.
// Assumptions: reliefs change the load, not R; a ridge at the start of a linear relief is not resolved.
#pragma once
#include "signal/response_result.h"
#include "signal/sweep_result.h"

namespace whine {

// Fills pair_phase, flank_roll, flank_pressure and edge_load; of lumped models nothing.
void add_flank_pressure(const SweepArtifact& sweep, ResponseArtifact& response);

}  // namespace whine
