// The keys of systems (several meshes, carriers, drives): the end of the table of scene keys.
//
// Private to the layer io/.
#pragma once
#include "io/keys.h"

namespace whine {

std::vector<Key> system_keys();

}  // namespace whine
