#include "gear/layout.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace whine {

Vec2 line_of_action(const System::Mesh& mesh) {
  // As contact_normal() has it for a first side that turns counter-clockwise and pushes upwards; else its mirror image.
  const double along = -std::cos(mesh.pressure_angle) * mesh.side[0].sense,
               away = (mesh.ring_drives ? -1 : 1) * std::sin(mesh.pressure_angle);
  return Eigen::Rotation2Dd(mesh.direction - 0.5 * std::numbers::pi) * Vec2(along, away);
}

Vec2 pin_direction(const System& system, const System::Body& planet) {
  const System::Body& carrier = system.bodies[static_cast<size_t>(planet.on)];
  const double x = planet.centre[0] - carrier.centre[0], y = planet.centre[1] - carrier.centre[1];
  return carrier.sense * Vec2(-y, x) / carrier.radius;
}

CarriedMesh carried_mesh(const System& system, size_t m) {
  const System::Mesh& mesh = system.meshes[m];
  CarriedMesh out;
  for (int s = 0; s < kSides; ++s) {
    const System::Body& body = system.bodies[static_cast<size_t>(mesh.side[static_cast<size_t>(s)].body)];
    if (body.on == System::kGround) continue;
    out.carrier = body.on;
    out.side = s;
    out.closing = closing_sign(s) * line_of_action(mesh).dot(pin_direction(system, body));
  }
  return out;
}

bool has_place(const System& layout, const System::Body& body) {
  if (body.on == System::kGround) return true;
  if (body.on < 0 || body.on >= static_cast<int>(layout.bodies.size())) return false;
  const System::Body& carrier = layout.bodies[static_cast<size_t>(body.on)];
  return carrier.kind == System::BodyKind::carrier && carrier.on == System::kGround;
}

bool moving_carrier(const System& layout, int b) {
  const System::Body& body = layout.bodies[static_cast<size_t>(b)];
  return body.kind == System::BodyKind::carrier && (!layout.held(b) || body.bearing.elastic());
}

bool on_rigid_moving_pin(const System& layout, int b) {
  const System::Body& body = layout.bodies[static_cast<size_t>(b)];
  return body.on != System::kGround && !body.bearing.elastic() && moving_carrier(layout, body.on);
}

}  // namespace whine
