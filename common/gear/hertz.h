// Hertz's line contact of a pair at the pitch point, in closed form: Johnson, Contact Mechanics (1985), section 4.2(c).
#pragma once
#include "model/stages.h"

namespace whine {

// The material with the plane state that the contact has; contact_plane as in GearMeshSpec.
inline Material in_contact_plane(Material material, ContactPlane contact_plane) {
  if (contact_plane != ContactPlane::body) material.plane_stress = contact_plane == ContactPlane::stress;
  return material;
}

struct HertzContact {
  double half_width = 0, pressure = 0;  // m, Pa: of the contact, largest
};

// Of a force (N) on one tooth pair, spread evenly over the common face width.
HertzContact hertz_contact(const GearPairParameters& pair, double force);

}  // namespace whine
