// Figures and tables of gears at rest: transmission error, stiffness, loads.
#pragma once
#include "report/figures.h"
#include "results/impact.h"
#include "results/response.h"

namespace whine {

// Static transmission error over a mesh period and its spectrum, one curve per torque in the order given. Throws
// Error(input) for no input or two of the same torque.
Figure transmission_error_figure(const std::vector<StaticResult>& statics);

// Mesh stiffness k = (T / r_b1) / transmission error over a mesh period and its spectrum, with the
// rectangular wave.
// The rectangular wave is that of the first artifact given.
Figure mesh_stiffness_figure(const std::vector<StaticResult>& statics);

// The share of the load that a tooth pair carries on its way through the mesh, one curve per torque in the order
// given, and the loads of all pairs over a mesh period at the first torque given. Throws Error(input) as transmission_error_figure.
Figure load_sharing_figure(const std::vector<StaticResult>& statics);

// Teeth that differ: static transmission error over the hunting period, its spectrum in orders of the mesh frequency, and that
// of the dynamic one at the speed of the sweep with the largest RMS. Orders 1 / teeth and their multiples are those of a shaft;
// beside a harmonic of the mesh frequency they are its sidebands. Throws Error(input) if the teeth are all alike, or the two
// are not of one torque and one hunting period.
Figure sidebands_figure(const StaticResult& statics, const ResponseResult& motion);

// A cracked tooth: static transmission error about the mesh periods in which it works, beside that of teeth without a crack,
// what it adds, and the spectrum in orders of the mesh frequency. Without a crack is what the pair shows while the cracked
// tooth is on the far side of its gear. Throws Error(input) for a pair without a crack or with errors tooth by tooth, which
// nothing tells from its mark.
Figure crack_figure(const StaticResult& statics);

}  // namespace whine
