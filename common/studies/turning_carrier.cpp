#include "studies/turning_carrier.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
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

namespace {

// Above this share of the mesh forces a sweep warns of what it leaves out: its pin forces are then no loads to design by.
constexpr double kNotedCentrifugal = 0.05;
// The same where the carrier is held and turns in the machine alone.
constexpr double kLargeCentrifugal = 0.1;

// What a sweep leaves out of a planetary train whose carrier turns, by its size at the highest speed.
Remark left_out(const System& layout, const TurningCarrier& of) {
  const std::string carrier = layout.bodies[static_cast<size_t>(of.carrier)].name;
  if (of.still < 0)
    return remark(
        true, "Coriolis and centrifugal forces on the planets of ", carrier,
        " are left out; how large they are the scene does not say, since no gear of its train is held");
  const std::string still = layout.bodies[static_cast<size_t>(of.still)].name;
  const std::string sizes =
      text("centrifugal forces on its planets of ", fixed(of.centrifugal_force, 0), " N (",
           fixed(of.relative_force() * 100, 1), " % of the largest mean mesh force, ",
           fixed(of.mesh_force, 0), " N) and Coriolis forces (", fixed(of.coriolis * 100, 1),
           " % of the inertia forces of motion at the mesh frequency) are left out");
  const std::string turns =
      text("turns at ", fixed(of.speed * 60 / kTwoPi, 0), " rpm at ", shown(of.mesh_frequency, 4), " Hz");
  if (of.turns)
    return remark(of.relative_force() > kNotedCentrifugal, carrier, " ", turns, ", ", still,
                  " being held: ", sizes,
                  "; add the former, which are constant and point outwards, to the mean forces on the pins");
  return remark(of.relative_force() > kLargeCentrifugal, "motions are relative to ", carrier,
                ". In a machine in which ", still, " stands still it ", turns, ": ", sizes);
}

}  // namespace

std::vector<Remark> left_out_of_carriers(const SystemSweepResult& sweep) {
  std::vector<Remark> out;
  for (const TurningCarrier& of : turning_carriers(sweep)) out.push_back(left_out(sweep.settings.layout, of));
  return out;
}

}  // namespace whine
