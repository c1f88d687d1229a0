#include "system/rest_record.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "system/face_mesh.h"
#include "system/mesh_record.h"

namespace whine {

using Eigen::Index;

namespace {

// What is kept of each position: loads, and the result itself.
void require_rows(const SystemModel& system, int periods, int positions) {
  constexpr double kMostMemory = 3e9;  // bytes
  const auto meshes = static_cast<double>(system.mesh.size()),
             bodies = static_cast<double>(system.body.size());
  constexpr double kOfMesh = 100, kOfBody = 20;  // numbers: of its pairs; places and forces
  const double memory = 8.0 * positions * periods * (meshes * (kOfMesh + 2 * meshes) + bodies * kOfBody);
  if (memory > kMostMemory)
    fail(Failure::input,
         periods > 1 ? text("the same teeth meet again after ", periods, " mesh periods; ") : "",
         static_cast<double>(positions) * periods, " positions of ", system.mesh.size(), " meshes need ",
         memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; lower positions in [discretisation]",
         periods > 1 ? ", or give errors to fewer gears" : "");
}

// Torques on bodies and forces on bearings; those of carriers follow from their planets.
void take_balance(const SystemModel& system, const SystemSolution& at, Index row, SystemStaticResult& out) {
  const System& layout = system.layout;
  MatrixRM& force = out.bearing_force[static_cast<size_t>(row)];
  // What a carrier is held by adds up below, also where a narrower zone has filled the row before.
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    const int number = static_cast<int>(b);
    out.torque(row, number) = layout.held(number) ? 0 : layout.torque(number);
  }
  for (size_t b = 0; b < system.body.size(); ++b) {
    const int number = static_cast<int>(b);
    force.row(number) = at.bearing_force[b].transpose();
    if (!layout.held(number)) continue;
    double moment = 0;  // N, of the contact forces over the base radius
    for (size_t m = 0; m < system.mesh.size(); ++m)
      if (const int side = system.side_of(number, static_cast<int>(m)); side >= 0)
        moment += side == 0 ? at.driving_force[m] : -at.driven_force[m];
    out.torque(row, number) = moment * system.base_radius(number);
  }
  for (size_t b = 0; b < system.body.size(); ++b) {
    const int on = layout.bodies[b].on;
    if (on == System::kGround) continue;
    const System::Body& carrier = layout.bodies[static_cast<size_t>(on)];
    const double x = layout.bodies[b].centre[0] - carrier.centre[0],
                 y = layout.bodies[b].centre[1] - carrier.centre[1];
    const Vec2& pin = at.bearing_force[b];
    force.row(on) += pin.transpose();
    if (!layout.held(on)) continue;
    out.torque(row, on) -= carrier.sense * (x * pin.y() - y * pin.x());
  }
}

void take_position(const SystemModel& system, const std::vector<int>& section, const SystemSolution& at,
                   Index row, SystemStaticResult& out) {
  std::vector<double> carried(section.size(), 0.0), force(system.mesh.size(), 0.0);
  for (const LoadedSegment& load : at.loads) {
    force[static_cast<size_t>(load.mesh)] += load.force;
    carried[static_cast<size_t>(section[static_cast<size_t>(load.mesh)])] += load.force;
  }
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const auto column = static_cast<Index>(m);
    const double all = carried[static_cast<size_t>(section[m])];
    out.mesh_deflection(row, column) = at.deflection[m];
    out.mesh_force(row, column) = force[m];
    out.load_share(row, column) = all > 0 ? force[m] / all : 0;
  }
  out.bearing_force[static_cast<size_t>(row)].setZero();
  for (size_t b = 0; b < system.layout.bodies.size(); ++b) {
    const auto column = static_cast<Index>(b);
    out.rotation(row, column) = at.equilibrium.x[column];
    if (const Bearing& bearing = system.layout.bodies[b].bearing; bearing.elastic())
      out.translation[static_cast<size_t>(row)].row(column) =
          at.bearing_force[b].transpose() / bearing.stiffness;
  }
  for (size_t b = 0; b < at.axial.force.size(); ++b) {
    out.axial_force(row, static_cast<Index>(b)) = at.axial.force[b];
    out.tilting_moment[static_cast<size_t>(row)].row(static_cast<Index>(b)) = at.axial.moment[b].transpose();
  }
  if (!out.mesh_stiffness.empty()) out.mesh_stiffness[static_cast<size_t>(row)] = at.mesh_stiffness;
  take_balance(system, at, row, out);
}

// [mesh] K_Hbeta of the pair at the pitch point, each mesh at its own phase 0.
std::vector<double> load_factors(const SystemModel& system, int strips) {
  // Tip edges that do not touch change nothing.
  constexpr double kFar = kWidening * kWidening;
  SystemStatics statics(system, ContactModel::line, static_zones(system, strips, 1, kFar));
  std::vector<double> out;
  out.reserve(system.mesh.size());
  Eigen::VectorXd start = Eigen::VectorXd::Zero(static_cast<Index>(system.layout.bodies.size()));
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const double ahead = system.layout.meshes[m].phase, phase = ahead > 0 ? 1 - ahead : 0;
    const SystemSolution& at = statics.solve(phase, 0, start);
    start = at.equilibrium.x;
    const SystemPosition& position = statics.position();
    out.push_back(load_factor(*system.face[m], position.mesh[m].face->points, position.mesh[m].phase,
                              at.equilibrium.p(position.strips_of(m))));
  }
  return out;
}

// [mesh] (gear) Pa: of the tooth whose root stress is the largest, at its phase in `of`; empty where it is not known.
std::vector<Eigen::VectorXd> largest_root_stresses(const SystemModel& system, int strips,
                                                   const std::vector<StaticResult>& of) {
  constexpr double kFar = kWidening * kWidening;
  SystemStatics statics(system, ContactModel::line, static_zones(system, strips, 1, kFar));
  std::vector<Eigen::VectorXd> out(of.size());
  Eigen::VectorXd start = Eigen::VectorXd::Zero(static_cast<Index>(system.layout.bodies.size()));
  for (size_t m = 0; m < of.size(); ++m) {
    const FaceRootStresses roots(*system.face[m]);
    if (!roots.known()) continue;
    out[m].resize(kSides);
    for (int g = 0; g < kSides; ++g) {
      const double place = of[m].root_stress_phase[g] - system.layout.meshes[m].phase;
      const SystemSolution& at = statics.solve(place - std::floor(place), 0, start);
      start = at.equilibrium.x;
      const SystemPosition& position = statics.position();
      const FaceMesh& face = *position.mesh[m].face;
      const int pair = static_cast<int>(std::lround(of[m].root_stress_phase[g] - position.mesh[m].phase));
      const auto side = static_cast<size_t>(g);
      out[m][g] = roots
                      .of_tooth(side, pair, face.points.line,
                                roots.loads(face, at.equilibrium.p(position.strips_of(m)))[side])
                      .most.stress;
    }
  }
  return out;
}

// Load factors, and what they and the largest root stresses change by with half as many points more and on bodies with two degrees less.
void take_load_factors(const SystemModel& system, int strips, SystemStaticResult& out) {
  const int points = system.face[0]->points(), degree = system.face[0]->degree();
  const std::vector<double> factor = load_factors(system, strips);
  for (size_t m = 0; m < factor.size(); ++m) out.mesh[m].face.load_factor = factor[m];
  const auto add_change = [&](int other_points, int other_degree) {
    const SystemModel changed = with_points(system, other_points, other_degree);
    const std::vector<double> other = load_factors(changed, strips);
    const std::vector<Eigen::VectorXd> stress = largest_root_stresses(changed, strips, out.mesh);
    for (size_t m = 0; m < factor.size(); ++m) {
      out.mesh[m].face.load_factor_error += std::abs(other[m] - factor[m]);
      if (stress[m].size() > 0)
        out.mesh[m].face.root_stress_error += (stress[m] - out.mesh[m].root_stress_max).cwiseAbs();
    }
  };
  add_change(points + points / 2, degree);
  if (degree > 0) add_change(points, degree - 2);
}

void finish_meshes(std::vector<MeshRecord>& records, SystemStaticResult& out) {
  int lowest = -1, highest = 1;
  for (const MeshRecord& record : records) {
    lowest = std::min(lowest, record.pairs().first);
    highest = std::max(highest, record.pairs().second);
  }
  out.mesh.reserve(records.size());
  for (MeshRecord& record : records) {
    const StaticResult& mesh = out.mesh.emplace_back(record.finish(lowest, highest));
    out.backlash_margin = std::min(out.backlash_margin, mesh.backlash_margin);
  }
  out.least_gap = out.mesh[0].least_gap;
  out.least_force = out.mesh[0].least_force;
  out.torque_residual = out.mesh[0].torque_residual;
  out.friction_coupling = out.mesh[0].friction_coupling;
}

}  // namespace

SystemStaticResult record_rest(const SystemModel& system, const std::vector<int>& section,
                               const std::vector<GearPairParameters>& of, double zone_factor, bool frozen) {
  const ContactDiscretisation& contact = of[0].contact;
  SystemStaticResult out;
  out.hunting_periods = hunting_periods(system);
  require_rows(system, out.hunting_periods, contact.positions);
  const Eigen::VectorXd load = mesh_loads(system);
  std::vector<MeshRecord> records;
  records.reserve(of.size());
  for (size_t m = 0; m < of.size(); ++m) {
    const double force = load[static_cast<Index>(m)],
                 drive = of.size() == 1 ? system.layout.torque(system.layout.meshes[m].side[0].body) : 0;
    records.emplace_back(system, static_cast<int>(m), of[m], force,
                         drive > 0 ? drive : force * system.mesh[m].kinematics.gear(0).base_radius());
  }
  const Index phases = Index{contact.positions} * out.hunting_periods,
              bodies = static_cast<Index>(system.layout.bodies.size()),
              meshes = static_cast<Index>(system.mesh.size());
  out.mesh_phase.setZero(phases);
  out.rotation = out.torque = MatrixRM::Zero(phases, bodies);
  out.mesh_deflection = out.mesh_force = out.load_share = MatrixRM::Zero(phases, meshes);
  out.translation.assign(static_cast<size_t>(phases), MatrixRM::Zero(bodies, 2));
  out.bearing_force = out.translation;
  if (!system.face.empty()) {
    out.axial_force.setZero(phases, bodies);
    out.tilting_moment = out.translation;
  }
  if (frozen) out.mesh_stiffness.assign(static_cast<size_t>(phases), MatrixRM::Zero(meshes, meshes));
  SystemSolution solution;
  over_period(system, of[0].fidelity.contact, contact.strips, contact.positions, zone_factor,
              [&](const RestStep& step, const SystemSolution& solved, const SystemStatics& statics) {
                const SystemSolution* at = &solved;
                if (frozen) {
                  solution = solved;
                  solution.mesh_stiffness = statics.mesh_stiffness();
                  at = &solution;
                }
                out.mesh_phase[step.row] = step.period + step.phase;
                take_position(system, section, *at, step.row, out);
                for (MeshRecord& record : records) record.take(step, *at, statics);
              });
  finish_meshes(records, out);
  if (!system.face.empty()) take_load_factors(system, contact.strips, out);
  return out;
}

}  // namespace whine
