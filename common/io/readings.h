// Readings of P2000: what the paper leaves open, the values that a search tries, and what each reading gives.
//
// A reading is one value for each open choice. The plan of a search is TOML:
//
//   title = "..."
//   scene = "../scenes/parker2000.toml"    # from the folder of the plan: all that no list below varies
//   seed = 1                               # of the draws
//   readings = 12                          # drawn for each pair of gears
//   [pair]                                 # every combination is a pair of gears
//   dedendum = [1.25, 1.4]                 # in modules
//   rack_tip_share = [0.3, 0.8]            # tip radius of the rack over the largest one that its tooth holds
//   tooth_thinning_mm = [0.0]
//   plane = ["stress", "strain"]
//   corner_contact = [false, 0.5, true]
//   [draw]                                 # one of each list for each reading
//   inertia_from = ["two", "mass"]         # what the inertia is fitted to: Table 1 at 100 N m (one, two, mean), all of it
// (table), or m = 1.4 kg (mass)
//   frequency_offset_percent = [0.0]       # of that frequency; Table 1 has steps of 20 Hz
//   damped_state = ["two"]                 # contact state with the printed damping ratio of 7 %: one, two, mean
//   mass_share = [0.0, 0.5]                # share of that ratio from mu of Eq. 21
//   undamped_depth_mm = [0.5, 1.0]
//   steps_per_period = [128]
//
// The bore of each pair is fitted to P2000's mean mesh stiffness.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

// The rule of a largest angle (rad), and back: 0 is no corner contact, pi any.
CornerRule corner_of(double angle);
double angle_of(const CornerRule& rule);

// The open choices of one reading as a plan names them.
struct OpenChoices {
  double dedendum = 1.25;        // modules
  double rack_tip_share = 0.8;   // 1: of the largest tip radius that the rack's tooth holds
  double tooth_thinning = 0;     // m
  std::string plane = "stress";  // or "strain"
  CornerRule corner;
  std::string inertia_from = "two", damped_state = "two";
  double frequency_offset = 0;     // 1: of the frequency that the inertia is fitted to
  double mass_share = 0;           // 1
  double undamped_depth = 0.5e-3;  // m
  int steps_per_period = 128;
};

struct ReadingPlan {
  std::string title, scene;  // scene: its path
  int seed = 1, readings = 1;
  std::vector<double> dedendum, rack_tip_share, tooth_thinning;
  std::vector<std::string> plane;
  std::vector<CornerRule> corner;
  std::vector<std::string> inertia_from, damped_state;
  std::vector<double> frequency_offset, mass_share, undamped_depth;
  std::vector<int> steps_per_period;
};

// Error(input) names file:line, key, value and limit; for an unknown key the nearest known one.
ReadingPlan read_reading_plan(const std::string& path);

// The pairs of gears of a plan, in a fixed order: body first, corner rule fastest.
std::vector<OpenChoices> pairs_of(const ReadingPlan& plan);

// Draw `index` for pair `pair`: depends on seed, pair and index alone.
OpenChoices draw(const ReadingPlan& plan, const OpenChoices& pair, int pair_number, int index);

}  // namespace whine
