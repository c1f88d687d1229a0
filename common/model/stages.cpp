#include "model/stages.h"

namespace whine {

void set_pair(GearPairParameters& pair, const std::array<BodyParameters, kSides>& gear,
              const StaticParameters& settings) {
  pair = {gear, settings.mesh, settings.fidelity, settings.contact};
}

void set_motion(MotionParameters& motion, const std::array<BodyParameters, kSides>& gear,
                const GearPairParameters& rest, const ImpactParameters& settings) {
  static_cast<GearPairParameters&>(motion) = {gear, rest.mesh, settings.fidelity, rest.contact};
  motion.damping = settings.damping;
  motion.inertia = settings.inertia;
}

}  // namespace whine
