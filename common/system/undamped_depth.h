// How wide a contact the undamped half-plane of a motion holds.
//
// In motion the half-plane relative to undamped_depth_mm (D) gives way at once and all below it with its damping. Under a pressure on
// a width 2 w its compliance is positive as long as
//   w < 2 D exp(-k),   k the mean of 1 / (2 (1 - nu)) of both gears by their log coefficients C
// (the capacity w / 2 of an interval against the constant of C (ln(D / |x|) - k)); Hertz's law of a line is used up to exp(-1/8) of it.
// Strips of a wider contact are solved as long as a time step is long against eta, for most of the rest then gives way within it.
#pragma once
#include <functional>
#include <string>

#include "contact/half_plane_strip.h"
#include "gear/scene_geometry.h"
#include "model/scene.h"

namespace whine {

// m: w above. depth: m, D.
double widest_half_width(const HalfPlaneSurface& driver, const HalfPlaneSurface& driven, double depth);

// Half-width (m) of a contact that is wider, in words with the remedy.
std::string beyond_undamped_depth(double half_width, double widest, double depth);

// ". torque_Nm = 80000 may be N mm: 80 N m pass" of a torque of 1000 N m or more, a thousandth of which passes; else "".
std::string torque_in_n_mm(double torque, const std::function<bool(double)>& passes);

// Throws Error(input), with its place, for a scene whose largest torque, carried by one pair of teeth, makes a contact by Hertz that its
// motion cannot hold: of lines, or of strips with time steps shorter than eta.
void check_undamped_depth(const Scene& scene, const System& layout, const ScenePlace& where);

}  // namespace whine
