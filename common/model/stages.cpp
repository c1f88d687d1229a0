#include "model/stages.h"

#include <cmath>

#include "base/error.h"

namespace whine {

std::vector<double> swept_speeds(const MeshSpeeds& speeds, Direction direction) {
  const auto& [from, to, step] = speeds;
  if (!(from > 0) || !(step > 0) || !(to >= from))
    fail(Failure::input, "the speed range from ", from, " to ", to, " Hz in steps of ", step,
         " Hz is empty; give mesh_frequency_Hz = { from, to, step }, all above 0, to not below from");
  const int count = static_cast<int>(std::floor((to - from) / step + 1e-9)) + 1;
  std::vector<double> out(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    out[static_cast<size_t>(i)] = from + (direction == Direction::up ? i : count - 1 - i) * step;
  return out;
}

MotionSettings motion_settings(const Scene& scene) {
  return {scene.operation, scene.damping, scene.time};
}

void set_pair(GearPairParameters& pair, const std::array<BodyParameters, kSides>& gear,
              const StaticParameters& settings) {
  pair = {gear, settings.mesh, settings.fidelity, settings.contact};
}

void set_motion(MotionParameters& motion, const std::array<BodyParameters, kSides>& gear,
                const GearPairParameters& rest, const SweepParameters& settings) {
  static_cast<GearPairParameters&>(motion) = {gear, rest.mesh, settings.fidelity, rest.contact};
  motion.damping = settings.damping;
  motion.time = settings.time;
  motion.inertia = settings.inertia;
}

}  // namespace whine
