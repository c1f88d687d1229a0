// A search over readings of P2000: its parts, what they make up together, its best looked at again.
#pragma once
#include <string>
#include <vector>

#include "paper/reading.h"

namespace whine {

// "dedendum 1.4, rack tip 0.5 of the largest, plane stress, no corner contact: 12 readings"
std::string pair_words(const OpenChoices& pair, int readings);

// Part `part` (from 1) of `parts` of the plan. A part takes whole families: pairs that share a tooth form and a plane state.
// What lies outside the model is told, counted and left out.
ReadingsResult run_part(const ReadingPlan& plan, const Scene& scene, int part, int parts,
                        const std::vector<Claim>& claims);

// The `count` best readings once more, with strips and finer steps of the speed.
ReadingsResult confirmed(const ReadingsResult& readings, const Scene& scene, int count,
                         const std::vector<Claim>& claims);

// Parts in one. Throws Error(input) for a part that is of other claims than the first.
ReadingsResult gathered(const std::vector<std::string>& parts);

}  // namespace whine
