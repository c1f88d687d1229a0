// Reading what a lumped model is made from, rejected where it does not go together.
#pragma once
#include <string>

#include "lumped/inputs.h"

namespace whine {

// Reads what is given; params and reference may be "". With params `options` takes the scene's samples, speeds and the mass of
// the gears' inertias; with_speeds: params must hold speeds. Throws Error(input) for teeth that differ, elastic bearings or a
// crack, for a reference that is not of the scene's first torque or not of the same pair.
LumpedInputs read_lumped_inputs(const std::string& statics, const std::string& reference,
                                const std::string& params, bool with_speeds, LumpedOptions& options);

}  // namespace whine
