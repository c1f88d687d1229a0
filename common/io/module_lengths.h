// Lengths whose default goes with the module, so that a scene that leaves them open has the same error at every module. The table of
// keys writes such a default as "module / 6"; a scene that has been read holds 0 until the gear is known whose module it is.
//
// Private to the layer io/.
#pragma once
#include "io/keys.h"

namespace whine {

// m: the default for a gear of this module (m); 0: the default of the key is no length that goes with it.
double length_of_module(const Key& key, double module);

// Gives those lengths of the list that the scene leaves open their defaults.
void take_module(const KeyList& keys, double module);

}  // namespace whine
