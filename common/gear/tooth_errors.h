// What a machine leaves on the driving flanks of a gear, tooth by tooth, as an inspection sheet has it: pitch, run-out,
// slope and form of the profile; given, or drawn at random within a class of ISO 1328-1.
//
// Signs are those of inspection: positive where material stands. Flanks are counted as teeth are, counter-clockwise; the
// driving flanks look that way on either gear, so that a positive cumulative pitch deviation brings a flank into contact
// early.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "gear/involute.h"
#include "model/gear.h"

namespace whine {

// Of one class of ISO 1328-1:2013, unrounded. m
struct FlankTolerances {
  double single_pitch = 0;      // f_pT: largest |pitch from flank to flank|
  double cumulative_pitch = 0;  // F_pT: highest less lowest cumulative deviation
  double profile_slope = 0;     // f_HalphaT: largest |f_Halpha|
  double profile_form = 0;      // f_falphaT
  double profile_total = 0;     // F_alphaT
  double run_out = 0;           // F_rT
};

// ISO 1328-1:2013, equations 5 to 9, and annex for the run-out. Throws Error(input), by the name of what it is, for a class
// that is not 1 to 11 and a gear outside the range of the formulas: 5 to 1000 teeth, reference diameter 5 to 15000 mm, module
// 0.5 to 70 mm, face width 4 to 1200 mm.
FlankTolerances iso_1328_tolerances(const GearDesign& design, int iso_class);

// Deviations of every tooth, all parts together.
struct ToothDeviations {
  std::vector<double> cumulative_pitch;  // (tooth) m along the reference circle, run-out apart
  std::vector<double> profile_slope;  // (tooth) m: rise from the foot to the tip, 0 at the reference circle
  std::vector<double> profile_form;  // (tooth) m: from peak to valley of the waves, 0 at the reference circle
};

// Throws Error(input), by the keys of a scene, for lists whose length is not the number of teeth, single pitch deviations
// that do not close over a turn, and what iso_1328_tolerances rejects. Single deviations whose sum is round-off of printed
// numbers (kClosure per tooth) are closed evenly: their sum is then 0. What is drawn depends on design, class, share and seed
// alone, to 1 nm, so that it is the same on every machine.
ToothDeviations tooth_deviations(const GearDesign& design, const ToothErrors& errors);

inline constexpr double kClosure = 0.01e-6;  // m

// (tooth) m: pitch from the flank before (tooth - 1, of tooth 0 the last) to this one; they sum up to 0.
std::vector<double> single_pitch(const std::vector<double>& cumulative);

}  // namespace whine
