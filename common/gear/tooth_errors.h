// What a machine leaves on the driving flanks of a gear, tooth by tooth, as an inspection sheet has it: pitch, run-out,
// slope and form of the profile; given, or drawn at random within a class of ISO 1328-1.
//
// Teeth are counted counter-clockwise, and a pitch deviation is a place along the reference circle in that direction, on either flank
// of a tooth. The leading flank looks that way: there a positive one is excess material and brings the flank into contact early;
// on the trailing flank it is material that is missing. Those of profiles are positive for excess material, on either flank. The
// pair of a scene works with its leading flanks, a gear of several meshes with either.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "gear/involute.h"
#include "model/scene.h"

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
// numbers (kClosure per tooth) are closed evenly: their sum is then 0. What is drawn depends on design, class, share, seed and flank
// alone, to 1 nm, so that it is the same on every machine.
//
// Lists are those of both flanks. Of a class each flank has a draw of its own, but for the share of pitch that turns once per
// revolution: that is a displacement of the whole toothing, whose wave on the trailing flank is behind by twice the pressure angle,
// of an internal gear ahead by it.
ToothDeviations tooth_deviations(const GearDesign& design, const ToothErrors& errors,
                                 FlankSide flank = FlankSide::leading);

inline constexpr double kClosure = 0.01e-6;  // m

// (tooth) m: pitch from the flank before (tooth - 1, of tooth 0 the last) to this one; they sum up to 0.
std::vector<double> single_pitch(const std::vector<double>& cumulative);

// Longest hunting period of a system, in mesh periods.
inline constexpr int kMostHuntingPeriods = 4096;

// Mesh periods after which the same teeth of a system meet again: the least common multiple of the numbers of teeth of the gears whose
// teeth differ; 1 for none. Throws Error(input), with the number, above kMostHuntingPeriods.
int hunting_periods_of(std::vector<int> teeth);

// The same of a scene; that of a pair has no limit.
int hunting_periods(const Scene& scene);

// Positions of the static stage in a mesh period: as the scene says; else 128, of a pair its steps_per_period if these are more, and fewer
// where teeth differ.
int static_positions(const Scene& scene);

}  // namespace whine
