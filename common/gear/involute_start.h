// Contacts that come near the root: where the involute of one gear begins.
#pragma once
#include "gear/pair.h"

namespace whine {

// Of a contact with pressure from `low` to `high` (m, tangential coordinates of the contact): the gear, 0 or 1, whose
// involute ends at its root within it, so that the flank that is touched there is none; -1: neither. A tip edge that ends the
// contact before is no such end.
int side_at_root(const GearPair& gears, const PairContact& contact, double low, double high);

}  // namespace whine
