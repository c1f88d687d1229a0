#include "system/rigid_system.h"

#include <cmath>

#include "base/error.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

void require(double value, const char* what, const std::string& name) {
  if (!(value > 0) || !std::isfinite(value))
    fail(Failure::input, "a rigid system needs ", what, " of '", name, "' above 0; it is ", value);
}

// How the place P of an axis moves with what carries it: a carrier, or the ground.
MatrixXd carried(const RigidSystem& system, int b) {
  const System::Body& body = system.layout.bodies[static_cast<size_t>(b)];
  if (body.on == System::kGround) return MatrixXd::Zero(2, system.rotation[0].cols());
  const auto c = static_cast<size_t>(body.on);
  return system.translation[c] + pin_direction(system.layout, body) * system.rotation[c];
}

// Numbers the freedoms and fills U and X; carriers come before what they carry.
void take_freedoms(RigidSystem& system) {
  const System& layout = system.layout;
  const int bodies = static_cast<int>(layout.bodies.size());
  Index freedoms = 0;
  std::vector<Index> turn(layout.bodies.size(), -1), move(layout.bodies.size(), -1);
  for (int b = 0; b < bodies; ++b) {
    if (!layout.held_rigidly(b)) turn[static_cast<size_t>(b)] = freedoms++;
    if (!layout.bodies[static_cast<size_t>(b)].bearing.elastic()) continue;
    move[static_cast<size_t>(b)] = freedoms;
    freedoms += 2;
  }
  if (freedoms == 0) fail(Failure::input, "all bodies are held; a system needs one that can move");
  system.rotation.assign(layout.bodies.size(), MatrixXd::Zero(1, freedoms));
  system.translation.assign(layout.bodies.size(), MatrixXd::Zero(2, freedoms));
  for (int b = 0; b < bodies; ++b)
    if (const Index at = turn[static_cast<size_t>(b)]; at >= 0)
      system.rotation[static_cast<size_t>(b)](0, at) = 1;
  for (const bool on_ground : {true, false})
    for (int b = 0; b < bodies; ++b) {
      const auto i = static_cast<size_t>(b);
      if ((layout.bodies[i].on == System::kGround) != on_ground) continue;
      if (move[i] >= 0)
        system.translation[i].middleCols(move[i], 2).setIdentity();
      else
        system.translation[i] = carried(system, b);
    }
}

void take_springs(RigidSystem& system, bool frozen) {
  const System& layout = system.layout;
  system.closing.resize(static_cast<Index>(layout.meshes.size()), system.rotation[0].cols());
  for (size_t m = 0; m < layout.meshes.size(); ++m) {
    const System::Mesh& mesh = layout.meshes[m];
    MatrixXd row = MatrixXd::Zero(1, system.rotation[0].cols());
    for (int s = 0; s < kSides; ++s) {
      const auto b = static_cast<size_t>(mesh.side[static_cast<size_t>(s)].body);
      row +=
          closing_sign(s) * (system.rotation[b] + line_of_action(mesh).transpose() * system.translation[b]);
    }
    // Frozen contact of a mesh without load has no stiffness.
    if (!frozen || mesh.stiffness != 0)
      require(mesh.stiffness, "a stiffness of the mesh", mesh_name(layout, m));
    system.springs.push_back({RigidSystem::Spring::Kind::mesh, static_cast<int>(m), row, mesh.stiffness});
    system.closing.row(static_cast<Index>(m)) = row;
  }
  for (size_t b = 0; b < layout.bodies.size(); ++b)
    if (const Bearing& bearing = layout.bodies[b].bearing; bearing.elastic())
      system.springs.push_back({RigidSystem::Spring::Kind::bearing, static_cast<int>(b),
                                system.translation[b] - carried(system, static_cast<int>(b)),
                                bearing.stiffness});
  for (const System::Drive& drive : layout.drives)
    if (drive.kind == System::DriveKind::held && drive.stiffness > 0)
      system.springs.push_back({RigidSystem::Spring::Kind::hold, drive.body,
                                system.rotation[static_cast<size_t>(drive.body)], drive.stiffness});
}

}  // namespace

RigidSystem rigid_system(const System& layout, const MatrixXd& mesh_stiffness) {
  RigidSystem out;
  out.layout = layout;
  const auto meshes = static_cast<Index>(layout.meshes.size());
  out.mesh_stiffness = mesh_stiffness;
  if (mesh_stiffness.size() == 0) out.mesh_stiffness.setZero(meshes, meshes);
  if (out.mesh_stiffness.rows() != meshes || out.mesh_stiffness.cols() != meshes)
    fail(Failure::input, "a system of ", meshes, " meshes is given the stiffness of ",
         out.mesh_stiffness.rows());
  for (Index m = 0; m < meshes; ++m) {
    double& own = out.layout.meshes[static_cast<size_t>(m)].stiffness;
    if (mesh_stiffness.size() == 0)
      out.mesh_stiffness(m, m) = own;
    else
      own = mesh_stiffness(m, m);
  }
  for (const System::Body& body : layout.bodies) {
    require(body.radius, "a radius", body.name);
    if (!has_place(layout, body))
      fail(Failure::input, "'", body.name, "' stands on number ", body.on,
           ", which is no carrier on the ground; a rigid system has no other place for it");
  }
  take_freedoms(out);
  take_springs(out, mesh_stiffness.size() > 0);
  const Index n = out.rotation[0].cols();
  out.mass = out.stiffness = out.gyroscopic = out.centrifugal = MatrixXd::Zero(n, n);
  const Eigen::Matrix2d quarter_turn{{0, -1}, {1, 0}};
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    const System::Body& body = layout.bodies[b];
    if (!layout.held_rigidly(static_cast<int>(b))) {
      require(body.inertia, "an inertia", body.name);
      out.mass += body.inertia / (body.radius * body.radius) * out.rotation[b].transpose() * out.rotation[b];
    }
    if (body.bearing.elastic()) require(body.bearing.mass, "a mass", body.name);
    const MatrixXd& moved = out.translation[b];
    out.mass += body.bearing.mass * moved.transpose() * moved;
    out.gyroscopic += body.bearing.mass * moved.transpose() * quarter_turn * moved;
    if (body.on == System::kGround) {
      out.centrifugal += body.bearing.mass * moved.transpose() * moved;
      continue;
    }
    const auto c = static_cast<size_t>(body.on);
    const MatrixXd round = pin_direction(layout, body) * out.rotation[c], from_pin = moved - round,
                   shifted = out.translation[c].transpose() * round;
    out.centrifugal += body.bearing.mass * (from_pin.transpose() * from_pin + shifted + shifted.transpose());
  }
  out.stiffness = out.closing.transpose() * out.mesh_stiffness * out.closing;
  for (const RigidSystem::Spring& spring : out.springs)
    if (spring.kind != RigidSystem::Spring::Kind::mesh)
      out.stiffness += spring.stiffness * spring.row.transpose() * spring.row;
  return out;
}

}  // namespace whine
