#include "io/layout_codec.h"

#include <algorithm>

#include "base/error.h"
#include "io/codec.h"
#include "io/keys.h"
#include "io/variant.h"
#include "system/rigid_system.h"

namespace whine {
namespace {

using namespace ranges;

// A system in columns, as its datasets have it.
struct Columns {
  std::vector<std::string> name;
  Eigen::VectorXi carrier, teeth, sense, on, ring_drives, held;
  Eigen::VectorXd angle, radius, inertia, stiffness, damping, mass, hold;
  MatrixRM centre;
  MatrixRMi side;
  Eigen::VectorXd distance, direction, phase, pressure_angle, mesh_stiffness;
};

Columns columns_of(const System& s) {
  const auto n = static_cast<Eigen::Index>(s.bodies.size()), m = static_cast<Eigen::Index>(s.meshes.size());
  Columns c;
  for (Eigen::VectorXi* list : {&c.carrier, &c.teeth, &c.sense, &c.on, &c.held}) list->setZero(n);
  for (Eigen::VectorXd* list : {&c.angle, &c.radius, &c.inertia, &c.stiffness, &c.damping, &c.mass, &c.hold})
    list->setZero(n);
  c.centre.resize(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const System::Body& b = s.bodies[static_cast<size_t>(i)];
    c.name.push_back(b.name);
    c.carrier[i] = b.kind == System::BodyKind::carrier;
    c.teeth[i] = b.teeth;
    c.sense[i] = b.sense;
    c.on[i] = b.on;
    c.angle[i] = b.angle;
    c.radius[i] = b.radius;
    c.inertia[i] = b.inertia;
    c.stiffness[i] = b.bearing.stiffness;
    c.damping[i] = b.bearing.damping;
    c.mass[i] = b.bearing.mass;
    c.centre.row(i) << b.centre[0], b.centre[1];
  }
  for (const System::Drive& drive : s.drives)
    if (drive.kind == System::DriveKind::held) {
      c.held[drive.body] = 1;
      c.hold[drive.body] = drive.stiffness;
    }
  c.ring_drives.setZero(m);
  for (Eigen::VectorXd* list : {&c.distance, &c.direction, &c.phase, &c.pressure_angle, &c.mesh_stiffness})
    list->setZero(m);
  c.side.resize(m, 2);
  for (Eigen::Index i = 0; i < m; ++i) {
    const System::Mesh& mesh = s.meshes[static_cast<size_t>(i)];
    c.side.row(i) << mesh.side[0].body, mesh.side[1].body;
    c.ring_drives[i] = mesh.ring_drives;
    c.distance[i] = mesh.centre_distance;
    c.direction[i] = mesh.direction;
    c.phase[i] = mesh.phase;
    c.pressure_angle[i] = mesh.pressure_angle;
    c.mesh_stiffness[i] = mesh.stiffness;
  }
  return c;
}

System system_of(const Columns& c) {
  System s;
  for (Eigen::Index i = 0; i < c.carrier.size(); ++i) {
    System::Body b;
    b.name = c.name[static_cast<size_t>(i)];
    b.kind = c.carrier[i] ? System::BodyKind::carrier : System::BodyKind::gear;
    b.teeth = c.teeth[i];
    b.sense = c.sense[i];
    b.on = c.on[i];
    b.angle = c.angle[i];
    b.radius = c.radius[i];
    b.inertia = c.inertia[i];
    b.bearing = {c.stiffness[i], c.damping[i], c.mass[i]};
    b.centre = {c.centre(i, 0), c.centre(i, 1)};
    s.bodies.push_back(b);
    if (c.held[i]) s.drives.push_back({static_cast<int>(i), System::DriveKind::held, 0, c.hold[i]});
  }
  for (Eigen::Index i = 0; i < c.distance.size(); ++i) {
    System::Mesh mesh;
    for (int k = 0; k < kSides; ++k) {
      mesh.side[static_cast<size_t>(k)].body = c.side(i, k);
      mesh.side[static_cast<size_t>(k)].sense = c.sense[c.side(i, k)];
    }
    mesh.ring_drives = c.ring_drives[i] != 0;
    mesh.centre_distance = c.distance[i];
    mesh.direction = c.direction[i];
    mesh.phase = c.phase[i];
    mesh.pressure_angle = c.pressure_angle[i];
    mesh.stiffness = c.mesh_stiffness[i];
    s.meshes.push_back(mesh);
  }
  return s;
}

void describe_bodies(Codec& codec, Columns& c) {
  const std::string at = "/body/";
  const Range count{-1, 10000};
  codec.dataset({at + "name", "1", "name of the body", "body_number"}, &c.name);
  codec.dataset({at + "is_carrier", "1", "1: a carrier, 0: a gear", "body_number", kFlag}, &c.carrier);
  codec.dataset({at + "teeth", "1", "number of teeth, 0 of a carrier", "body_number", kTooth}, &c.teeth);
  codec.dataset(
      {at + "sense", "1", "sense of rotation: 1 counter-clockwise, -1 clockwise", "body_number", {-1, 1}},
      &c.sense);
  codec.dataset({at + "stands_on", "1", "number of the carrier that carries the axis, -1: the ground",
                 "body_number", count},
                &c.on);
  codec.dataset({at + "centre", "m", "place of the axis", "body_number xy", kPlace}, &c.centre);
  codec.dataset({at + "angle", "rad", "angle of tooth 0 from +y at mesh phase 0, counter-clockwise",
                 "body_number", kSigned},
                &c.angle);
  codec.dataset({at + "radius", "m", "base radius; of a carrier that of the pins", "body_number", kRadius},
                &c.radius);
  codec.dataset({at + "inertia", "kg m2", "inertia about the axis", "body_number", {0, kKilograms}},
                &c.inertia);
  codec.dataset({at + "mass",
                 "kg",
                 "mass of what moves with the hub; 0: rigid bearing",
                 "body_number",
                 {0, kKilograms}},
                &c.mass);
  codec.dataset(
      {at + "bearing_stiffness", "N m-1", "radial stiffness of the bearing; 0: rigid", "body_number", kStiff},
      &c.stiffness);
  codec.dataset(
      {at + "bearing_damping", "N s m-1", "radial damping of the bearing", "body_number", {0, kStiffnesses}},
      &c.damping);
  codec.dataset({at + "held", "1", "1: a drive holds the rotation", "body_number", kFlag}, &c.held);
  codec.dataset({at + "hold_stiffness", "N m-1", "stiffness of what holds it, at the radius; 0: rigid",
                 "body_number", kStiff},
                &c.hold);
}

void describe_meshes(Codec& codec, Columns& c) {
  const std::string at = "/mesh/";
  codec.dataset(
      {at + "body_number", "1", "numbers of the driving and the driven body", "mesh_number gear", {0, 10000}},
      &c.side);
  codec.dataset({at + "ring_drives", "1", "1: the driving gear is internal", "mesh_number", kFlag},
                &c.ring_drives);
  codec.dataset({at + "centre_distance", "m", "distance of the axes", "mesh_number", kSize}, &c.distance);
  codec.dataset(
      {at + "direction", "rad", "from the driving body's axis to the pitch point, counter-clockwise from +x",
       "mesh_number", kSigned},
      &c.direction);
  codec.dataset({at + "phase", "1", "mesh periods that it is ahead of the first mesh", "mesh_number", kShare},
                &c.phase);
  codec.dataset({at + "pressure_angle", "rad", "working pressure angle", "mesh_number", {0, 1.5}},
                &c.pressure_angle);
  codec.dataset({at + "stiffness", "N m-1", "mean stiffness along the line of action", "mesh_number", kStiff},
                &c.mesh_stiffness);
}

// What figures and the views of modes divide by, and what they look up.
void require_gears(const Codec& c, const System& s) {
  const auto reject = [&](const auto&... words) { c.in()->reject(text(words...)); };
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    const bool gear = body.kind == System::BodyKind::gear;
    if (!plain_name(body.name))
      reject("dataset /body/name holds '", body.name, "'; a name holds letters, digits, '_' and '-' only");
    if (body.sense == 0) reject("dataset /body/sense holds 0 of body ", b, "; allowed are -1 and 1");
    if (gear && body.teeth == 0) reject("dataset /body/teeth holds 0 of body ", b, ", which is a gear");
    if (!has_place(s, body))
      reject("dataset /body/stands_on holds ", body.on, " of body ", b,
             "; allowed are -1, the ground, and the number of a carrier on the ground");
  }
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const auto& [first, second] = s.meshes[m].side;
    for (const System::Side& side : {first, second})
      if (s.bodies[static_cast<size_t>(side.body)].kind == System::BodyKind::carrier ||
          first.body == second.body)
        reject("dataset /mesh/body_number holds ", first.body, ", ", second.body, " of mesh ", m,
               "; allowed are two gears that differ");
  }
}

}  // namespace

void describe_layout(Codec& c, System& layout) {
  Columns columns = columns_of(layout);
  describe_bodies(c, columns);
  describe_meshes(c, columns);
  if (!c.in()) return;
  require_indices(c, "/mesh/body_number", columns.side, columns.carrier.size());
  layout = system_of(columns);
  require_gears(c, layout);
}

void describe_errors(Codec& c, SystemStaticParameters& s) {
  if (c.in()) s.errors.resize(s.layout.bodies.size());
  bool differ = false;
  for (size_t b = 0; !c.lists() && b < s.layout.bodies.size(); ++b) {
    const std::string section = "error_" + s.layout.bodies[b].name;
    if (!c.optional("/parameters/" + section + "/iso_class", s.has_errors(b))) continue;
    differ = true;
    SceneParameters values;
    if (b < s.errors.size()) values.errors = s.errors[b];
    c.parameters(section, values, KeyGroup::error);
    if (c.in()) s.errors[b] = values.errors;
  }
  if (!differ && !c.lists()) return;
  MatrixRMi tooth(static_cast<Eigen::Index>(s.layout.meshes.size()), 2);
  for (Eigen::Index m = 0; m < tooth.rows(); ++m)
    for (Eigen::Index side = 0; side < 2; ++side)
      tooth(m, side) = s.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(side)].first_tooth;
  c.dataset(
      {"/mesh/first_tooth",
       "1",
       "where teeth differ: tooth of each side in the reference pair of mesh period 0, counter-clockwise; in mesh period k pair p is that of first_tooth + sense (p - k)",
       "mesh_number side",
       {-(1 << 20), 1 << 20}},
      &tooth);
  if (!c.in()) return;
  for (Eigen::Index m = 0;
       m < std::min<Eigen::Index>(tooth.rows(), static_cast<Eigen::Index>(s.layout.meshes.size())); ++m)
    for (Eigen::Index side = 0; side < 2; ++side)
      s.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(side)].first_tooth = tooth(m, side);
}

}  // namespace whine
