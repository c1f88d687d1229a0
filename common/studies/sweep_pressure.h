// Flank pressure over the flank and over speed, from the tooth loads of a sweep, by Hertz's law of a line.
//
//   p_H = sqrt(F E* / (pi b R)),   a = sqrt(4 F R / (pi b E*))
// F the load of a pair, b the face width, R the relative radius of curvature at the nominal touching point, E* of both materials
// in the plane state of the contact, a the half width.
//
// Flanks and tip edges are apart. A tip edge is sharp in this model, and the pressure of an edge on a flank is singular: no pressure is
// stated there. Of pairs that touch at a tip edge off the line of action, and of contacts that reach a tip edge (the half width
// is beyond its distance), the load is stated instead, by the gear whose edge it is.
//
// Over speed: the largest that a pair sustains for 1/64 of a mesh period, wherever that begins, inside its flanks (pressure) and over either
// edge (load), as sustained_load() of signal/branches.h. Over the flanks: a pair passes each place once in a mesh period; places are 1/64 of
// a mesh period wide, and the load of a place is the least of the samples there (4 of 256 steps, 2 of 128; one of 64 steps or fewer). So
// spikes of single samples, whose height depends on the time step, do not count. At each place and speed there is a pressure, or a load
// over an edge, or neither: then no load is sustained there.
// Assumptions: reliefs change the load, not R; a ridge at the start of a linear relief is not resolved.
#pragma once
#include "results/response.h"
#include "results/sweep.h"

namespace whine {

// Fills pair_phase, flank_roll, flank_pressure, edge_load_there, flank_pressure_sustained and edge_load; of lumped models nothing.
void add_flank_pressure(const SweepResult& sweep, ResponseResult& response);

}  // namespace whine
