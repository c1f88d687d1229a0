#include "gear/train.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/helix.h"

namespace whine {
namespace {

// rad, counter-clockwise from tooth 0: of its flank where that meets the pitch circle of a mesh.
double flank_angle(const GearPair& pair, int side, FlankSide flank) {
  const Vec2 p = pair.gear(side).flank_point(std::tan(pair.working_pressure_angle()));
  const double leading = std::atan2(p.y(), p.x()) - 0.5 * kPi;
  return flank == FlankSide::leading ? leading : -leading;
}

bool in_mesh(const System& system, int body) {
  for (const System::Mesh& mesh : system.meshes)
    for (const System::Side& side : mesh.side)
      if (side.body == body) return true;
  return false;
}

}  // namespace

int add_input_gear(System& system, const std::string& name, const GearDesign& gear, const Bearing& bearing) {
  system.bodies.push_back({name, gear.teeth, 1, 0, {}, bearing});
  system.bodies.back().radius = ToothGeometry(gear).base_radius();
  return static_cast<int>(system.bodies.size()) - 1;
}

namespace {

// The mesh of body `on`, which turns already, with one that is to have the number `second`. Sets the angle of `on` if this is its
// first mesh.
System::Mesh mesh_on(System& system, int on, const GearPair& pair, int second, double direction) {
  System::Body& first = system.bodies[static_cast<size_t>(on)];
  const FlankSide flank = first.sense > 0 ? FlankSide::leading : FlankSide::trailing;
  // A ring and its pinion turn in the same sense, so that one pushes with what leads and the other is pushed at what trails.
  const bool leads = (first.sense > 0) != pair.internal();
  const FlankSide second_flank = leads ? FlankSide::leading : FlankSide::trailing;
  const int second_sense = pair.internal() ? first.sense : -first.sense;
  const double from_tooth = flank_angle(pair, 0, flank);
  // Angles stand from +y, directions from +x.
  const double towards = direction - 0.5 * kPi;
  System::Mesh mesh;
  mesh.centre_distance = pair.centre_distance();
  mesh.direction = direction;
  mesh.pressure_angle = pair.working_pressure_angle();
  mesh.ring_drives = pair.ring() == 0;
  mesh.side = {System::Side{on, flank, first.sense, 0}, System::Side{second, second_flank, second_sense, 0}};
  if (!in_mesh(system, on)) {
    first.angle = towards - from_tooth;
  } else {
    const double ahead = first.sense * (first.angle + from_tooth - towards) * first.teeth / (2 * kPi);
    constexpr double kRoundOff = 1e-9;  // pitches: a phase of 0 is 0, not 1
    const double whole = std::floor(ahead + kRoundOff);
    mesh.phase = std::max(0.0, ahead - whole);
    mesh.side[0].first_tooth = -first.sense * static_cast<int>(whole);
  }
  return mesh;
}

// rad: at which tooth 0 of the second side stands at phase 0 of the system.
double second_angle(const GearPair& pair, const System::Mesh& mesh) {
  const System::Side& side = mesh.side[1];
  return mesh.direction - 0.5 * kPi + (pair.internal() ? 0 : kPi) - flank_angle(pair, 1, side.flank) +
         side.sense * mesh.phase * 2 * kPi / pair.gear(1).design().teeth;
}

}  // namespace

int add_driven_gear(System& system, int on, const GearDesign& driver, const std::string& name,
                    const GearDesign& gear, double centre_distance, double direction,
                    const Bearing& bearing) {
  const GearPair pair(driver, gear, centre_distance);
  const int number = static_cast<int>(system.bodies.size());
  const System::Mesh mesh = mesh_on(system, on, pair, number, direction);
  System::Body second{
      name, gear.teeth, mesh.side[1].sense, 0, system.bodies[static_cast<size_t>(on)].centre, bearing};
  second.centre[0] += pair.driven_centre_offset() * std::cos(direction);
  second.centre[1] += pair.driven_centre_offset() * std::sin(direction);
  second.angle = second_angle(pair, mesh);
  second.radius = pair.gear(1).base_radius();
  system.bodies.push_back(second);
  system.meshes.push_back(mesh);
  return number;
}

double add_mesh(System& system, int on, const GearDesign& driver, int to, const GearDesign& gear) {
  const System::Body &first = system.bodies[static_cast<size_t>(on)],
                     &second = system.bodies[static_cast<size_t>(to)];
  const double x = second.centre[0] - first.centre[0], y = second.centre[1] - first.centre[1];
  const GearPair pair(driver, gear, std::hypot(x, y));
  const double away = pair.driven_centre_offset() > 0 ? 1 : -1;
  System::Mesh mesh = mesh_on(system, on, pair, to, std::atan2(away * y, away * x));
  if (mesh.side[1].sense != second.sense)
    fail(Failure::input, "[gear.", second.name, "] would have to turn in both senses");
  const double pitches = (second_angle(pair, mesh) - second.angle) * second.teeth / (2 * kPi);
  mesh.side[1].first_tooth = static_cast<int>(std::lround(pitches));
  system.meshes.push_back(mesh);
  return pitches - std::round(pitches);
}

System pair_system(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven) {
  System system;
  add_input_gear(system, mesh.gear[0], driver, mesh.bearing[0]);
  const int output = add_driven_gear(system, 0, driver, mesh.gear[1], driven, mesh.centre_distance, 0.5 * kPi,
                                     mesh.bearing[1]);
  system.drives.push_back({output, System::DriveKind::held, 0});
  return system;
}

System pair_system(const MotionParameters& pair) {
  System system = pair_system(pair.mesh, transverse_section(pair.gear[0].design),
                              transverse_section(pair.gear[1].design));
  for (size_t g = 0; g < kSides; ++g) system.bodies[g].inertia = pair.inertia[g];
  return system;
}

}  // namespace whine
