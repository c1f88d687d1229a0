// What a publication prints of jumps and tooth loads, to stand beside maps of the same gears.
#pragma once
#include <string>
#include <vector>

#include "model/stages.h"

namespace whine {

struct PrintedJumps {
  bool (*of_pair)(const GearPairParameters& pair) =
      nullptr;                       // whether these are its gears; nullptr: nothing is printed
  std::string source;                // "P2000"
  double damping_ratio = 0;          // 1: of its elastic pair
  double lumped_damping_ratio = 0;   // 1: of its lumped models
  std::vector<double> torques;       // N m, at which it prints or draws jumps
  std::string torque_words;          // the same, "100 to 300 and 600 N m"
  double load_torque = 0;            // N m, at which it prints tooth loads
  std::string loads;                 // kN, "3.00 and 4.85"
  double lost_torque = 0;            // N m, at which its lumped model loses contact
  std::vector<double> kept_torques;  // N m, at which it keeps contact, ascending
  std::string lost_words;            // which model and where, "P2000's second lumped model (Figure 16)"
};

}  // namespace whine
