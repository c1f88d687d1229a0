#include "studies/turning_carrier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "gear/system_layout.h"

namespace whine {

using Eigen::Index;

namespace {

// What the frame leaves out of elastic modes at its speed.
void take_elastic(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                  TurningCarrier& of) {
  const std::vector<double> turns = train_speeds(settings.layout).turns;
  for (size_t b = 0; b < settings.layout.bodies.size(); ++b)
    for (size_t n = 0; n < settings.body.size() && n < bodies.size(); ++n) {
      if (settings.body[n].first != settings.gear[b] || bodies[n].eigenfrequency.size() == 0) continue;
      const double lowest = bodies[n].eigenfrequency.minCoeff(),
                   share = 2 * std::abs(turns[b]) * of.mesh_frequency / lowest;
      if (!(share > of.elastic)) continue;
      of.elastic = share;
      of.elastic_frequency = lowest;
      of.elastic_body = static_cast<int>(b);
    }
}

}  // namespace

std::vector<TurningCarrier> turning_carriers(const SweepResult& sweep, const SystemStaticParameters& settings,
                                             const std::vector<ReducedBody>& bodies) {
  const System& layout = sweep.layout;
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
      of.in_motion = frame_turns(layout) != 0;
      if (of.in_motion) take_elastic(settings, bodies, of);
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

// What a sweep has and leaves out of a planetary train whose carrier turns, by its size at the highest speed.
Remark remark_on(const System& layout, const TurningCarrier& of) {
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
           " % of the inertia forces of motion at the mesh frequency)");
  const std::string turns =
      text("turns at ", fixed(of.speed * 60 / kTwoPi, 0), " rpm at ", shown(of.mesh_frequency, 4), " Hz");
  if (of.in_motion)
    return remark(
        false, carrier, " ", turns, ", ", still, " being held: ", sizes,
        " are in the motions and in the forces on pins and bearings, with the mass of each gear as one; of elastic modes they are left out",
        of.elastic_body < 0
            ? std::string()
            : text(", at most ", shown(of.elastic * 100, 2), " % of the inertia forces of the lowest one of ",
                   layout.bodies[static_cast<size_t>(of.elastic_body)].name, ", at ",
                   shown(of.elastic_frequency, 4), " Hz"));
  if (of.turns)
    return remark(
        of.relative_force() > kNotedCentrifugal, carrier, " ", turns, ", ", still, " being held: ", sizes,
        " are left out; add the former, which are constant and point outwards, to the mean forces on the pins");
  return remark(of.relative_force() > kLargeCentrifugal, "motions are relative to ", carrier,
                ". In a machine in which ", still, " stands still it ", turns, ": ", sizes,
                " are left out; give ", carrier, " a [[drive]] with its torque, and only ", still,
                " one that is held, to have them");
}

}  // namespace

std::vector<Remark> remarks_on_carriers(const SweepResult& sweep, const SystemStaticParameters& settings,
                                        const std::vector<ReducedBody>& bodies) {
  std::vector<Remark> out;
  for (const TurningCarrier& of : turning_carriers(sweep, settings, bodies))
    out.push_back(remark_on(sweep.layout, of));
  return out;
}

}  // namespace whine
