#include "studies/turning_carrier.h"

#include <algorithm>
#include <numbers>

#include "gear/system_layout.h"

namespace whine {

using Eigen::Index;

std::vector<TurningCarrier> turning_carriers(const SystemSweepResult& sweep) {
  const System& layout = sweep.settings.layout;
  std::vector<TurningCarrier> out;
  if (sweep.mesh_frequency.size() == 0) return out;
  Index fastest = 0;
  const double frequency = sweep.mesh_frequency.maxCoeff(&fastest);
  for (int carrier = 0; carrier < static_cast<int>(layout.bodies.size()); ++carrier) {
    const System::Body& own = layout.bodies[static_cast<size_t>(carrier)];
    if (own.kind != System::BodyKind::carrier) continue;
    TurningCarrier of;
    of.carrier = carrier;
    of.turns = !layout.held(carrier);
    of.mesh_frequency = frequency;
    double mass = 0;
    for (const System::Body& planet : layout.bodies)
      if (planet.on == carrier) mass = std::max(mass, planet.bearing.mass);
    for (size_t m = 0; m < layout.meshes.size(); ++m) {
      const auto& side = layout.meshes[m].side;
      const auto on_it = [&](size_t s) {
        return layout.bodies[static_cast<size_t>(side[s].body)].on == carrier;
      };
      if (!on_it(0) && !on_it(1)) continue;
      of.mesh_force = std::max(
          of.mesh_force, sweep.mesh_force[static_cast<size_t>(fastest)].col(static_cast<Index>(m)).mean());
    }
    of.still = held_by_planets(layout, carrier);
    if (of.still < 0 && !of.turns) continue;
    if (of.still >= 0) {
      const int teeth = layout.bodies[static_cast<size_t>(of.still)].teeth;
      of.speed = 2 * std::numbers::pi * frequency / teeth;
      of.centrifugal_force = mass * own.radius * of.speed * of.speed;
      of.coriolis = 2.0 / teeth;
    }
    out.push_back(of);
  }
  return out;
}

}  // namespace whine
