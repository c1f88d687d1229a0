#include "gear/involute_start.h"

#include <cmath>

namespace whine {

int side_at_root(const GearPair& gears, const PairContact& contact, double low, double high) {
  if (low <= contact.x_min && !std::isfinite(gears.edge_distance(contact, 1))) return 0;
  if (high >= contact.x_max && !std::isfinite(gears.edge_distance(contact, 0))) return 1;
  return -1;
}

}  // namespace whine
