#include "system/axial_loads.h"

#include <cmath>

#include "gear/layout.h"
#include "system/face_mesh.h"

namespace whine {

using Eigen::Index;

namespace {

Vec2 place(const System::Body& body) {
  return {body.centre[0], body.centre[1]};
}

// About x and y: (at, z) x (force, axial).
Vec2 tilting(const Vec2& at, double z, const Vec2& force, double axial) {
  return {at.y() * axial - z * force.y(), z * force.x() - at.x() * axial};
}

}  // namespace

AxialLoads axial_loads(const SystemModel& system, const SystemPosition& position,
                       const Eigen::Ref<const Eigen::VectorXd>& p) {
  const System& layout = system.layout;
  AxialLoads out{std::vector<double>(layout.bodies.size(), 0.0),
                 std::vector<Vec2>(layout.bodies.size(), Vec2::Zero())};
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const System::Mesh& mesh = layout.meshes[m];
    const FacePoints& points = position.mesh[m].face->points;
    const GearPair& gears = system.face[m]->gears();
    const int towards = mesh.side[0].sense;  // of z of the mesh
    const double sine = towards * std::sin(gears.base_helix_angle()),
                 pitch_radius = gears.gear(0).base_radius() / std::cos(gears.working_pressure_angle());
    const Vec2 along = line_of_action(mesh),
               pitch_point = place(layout.bodies[static_cast<size_t>(mesh.side[0].body)]) +
                             pitch_radius * Vec2(std::cos(mesh.direction), std::sin(mesh.direction));
    for (Index q = 0; q < points.size(); ++q) {
      const double force = p[position.first_strip[m] + q], z = towards * points.z[q];
      const Vec2 at = pitch_point + points.path[q] * along;
      const Vec2& normal =
          position.segment[static_cast<size_t>(position.first_strip[m] + q)].normal;  // cos beta_b long
      for (int s = 0; s < kSides; ++s) {
        const auto b = static_cast<size_t>(mesh.side[static_cast<size_t>(s)].body);
        const double axial = closing_sign(s) * force * sine;
        out.force[b] += axial;
        out.moment[b] += tilting(at - place(layout.bodies[b]), z, -closing_sign(s) * force * normal, axial);
      }
    }
  }
  for (size_t b = 0; b < system.body.size(); ++b) {
    const int on = layout.bodies[b].on;
    if (on == System::kGround) continue;
    const auto carrier = static_cast<size_t>(on);
    out.force[carrier] += out.force[b];
    out.moment[carrier] += out.moment[b] + tilting(place(layout.bodies[b]) - place(layout.bodies[carrier]), 0,
                                                   Vec2::Zero(), out.force[b]);
  }
  return out;
}

}  // namespace whine
