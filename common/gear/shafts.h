// Gears and carriers whose rotation can stand for the mesh frequency, by their names.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "gear/train.h"

namespace whine {

// speed (rpm) = 60 turns x mesh frequency (Hz).
struct Shaft {
  std::string gear;
  double turns = 0;       // revolutions in a mesh period: of a gear whose axis stands still 1 / teeth
  std::string role = {};  // "driver", by which it may be called, too; "": none
  std::string with = {};  // against what it turns: "carrier at rest"; "": nothing that has to be said
};

// Of a train, one a body. Throws Error(input) where speeds do not follow from what is held.
std::vector<Shaft> shafts_of(const System& system);
// Of a pair, the driver first.
std::vector<Shaft> shafts_of(const std::array<std::string, kSides>& gears,
                             const std::array<int, kSides>& teeth);

// The one that an axis names: "rpm:<gear>", "rpm:driver". Throws Error(usage) where there is none and where it stands still; said:
// "AXIS=rpm:x", with which the message begins.
const Shaft& shaft_called(const std::string& axis, const std::vector<Shaft>& shafts, const std::string& said);

}  // namespace whine
