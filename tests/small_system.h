// A system at rest and its sweep, with numbers without meaning, for what is written, read and drawn of them.
#pragma once
#include <Eigen/Core>

#include "gear/layout.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "planetary_train.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep.h"
#include "studies/turning_carrier.h"
#include "system/drawing_remarks.h"

// Mesh m of a train at two phases.
inline whine::StaticResult small_mesh(const whine::SystemStaticResult& a, size_t m) {
  using namespace whine;
  StaticResult mesh;
  static_cast<GearPairParameters&>(mesh) = mesh_parameters(a, m);
  mesh.torque = 30.25;
  mesh.contact_ratio = 1.4 + 0.1 * static_cast<double>(m);
  mesh.mesh_phase = a.mesh_phase.array() + a.settings.layout.meshes[m].phase;
  mesh.pair = Eigen::Vector3i(-1, 0, 1);
  mesh.transmission_error = Eigen::VectorXd::Constant(2, 2.5e-6);
  mesh.unloaded_error = Eigen::VectorXd::Zero(2);
  mesh.stiffness_secant = mesh.stiffness_tangent = Eigen::VectorXd::Constant(2, 5e8);
  mesh.mean_stiffness = 5e8;
  mesh.tooth_load = MatrixRM::Constant(2, 3, 1000.0 / 3);
  mesh.contact_pressure = MatrixRM::Constant(2, 3, 1e9 / 3);
  mesh.contact_half_width = MatrixRM::Constant(2, 3, 1e-4 / 3);
  mesh.root_stress = {MatrixRM::Constant(2, 3, 1e8 / 3), MatrixRM::Constant(2, 3, 1e8 / 7)};
  mesh.root_stress_max = Eigen::Vector2d(1e8 / 3, 1e8 / 7);
  mesh.root_stress_angle = Eigen::Vector2d(0.5, 0.75);
  mesh.root_stress_phase = Eigen::Vector2d(0.25, 0.125);
  mesh.flank_pressure.smooth = 1e9 / 3;
  mesh.transmission_error_harmonic = Eigen::VectorXd::Constant(1, 2.5e-6);
  mesh.stiffness_harmonic = Eigen::VectorXd::Constant(1, 5e8);
  return mesh;
}

// A train at two phases, numbers without meaning.
inline whine::SystemStaticResult small_system(whine::Scene scene = planetary_train(3)) {
  using namespace whine;
  scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  // Of sun and planet, one of them in two meshes, and none of the ring.
  FlankModification relieved, crowned;
  relieved.tip.amount = 20e-6;
  relieved.tip.length = 1.5e-3;
  crowned.crowning = 5e-6;
  for (Scene::Mesh& mesh : scene.meshes)
    for (size_t g = 0; g < kSides; ++g) {
      if (mesh.spec.gear[g] == "sun") mesh.spec.modification[g] = relieved;
      if (mesh.spec.gear[g] == "planet") mesh.spec.modification[g] = crowned;
    }
  scene.contact = {4, 2};
  const SystemStaticParameters settings = static_parameters_of(scene, layout_of(scene));
  const auto bodies = static_cast<Eigen::Index>(settings.layout.bodies.size()),
             meshes = static_cast<Eigen::Index>(settings.layout.meshes.size());
  SystemStaticResult a;
  a.settings = settings;
  for (const SceneGear& gear : scene.gears) {
    a.drawing.push_back({gear.design, Material{206e9, 0.3, 7850, true}, {}});
    a.drawing.back().design.bore_radius = gear.design.internal ? 0 : 10e-3;
    a.drawing.back().discretisation.element_size = 1e-3;
  }
  a.mesh_phase = Eigen::Vector2d(0, 0.5);
  a.rotation = MatrixRM::Constant(2, bodies, 1.25e-6);
  a.torque = MatrixRM::Constant(2, bodies, -12.5);
  a.mesh_deflection = MatrixRM::Constant(2, meshes, 2.5e-6);
  a.mesh_force = MatrixRM::Constant(2, meshes, 1000.5);
  a.load_share = MatrixRM::Constant(2, meshes, 1.0 / 3);
  a.translation.assign(2, MatrixRM::Constant(bodies, 2, 1e-6 / 3));
  a.bearing_force.assign(2, MatrixRM::Constant(bodies, 2, 100.0 / 3));
  a.mesh_stiffness.assign(2, MatrixRM::Identity(meshes, meshes) * 5e8);
  a.torque_residual = 1e-13;
  for (const System::Body& body : settings.layout.bodies) a.body_names.push_back(body.name);
  for (size_t m = 0; m < settings.layout.meshes.size(); ++m) {
    a.mesh_names.push_back(mesh_name(settings.layout, m));
    a.mesh.push_back(small_mesh(a, m));
  }
  a.remarks = drawing_remarks(a);
  return a;
}

// Of the same torques, at two speeds.
inline whine::SweepResult small_sweep(const whine::SystemStaticResult& rest, whine::Direction direction) {
  using namespace whine;
  SweepResult a;
  a.layout = rest.settings.layout;
  a.section = rest.settings.section;
  a.errors = rest.settings.errors;
  a.fidelity = rest.settings.fidelity;
  a.name_parts();
  a.damping.rayleigh_stiffness = 2e-6;
  a.direction = direction;
  const Eigen::Index bodies = a.bodies(), meshes = a.meshes();
  a.drive = rest.torque.colwise().mean().transpose();
  a.axis_frequency = 1e4 / 3;
  a.mesh_frequency = Eigen::Vector2d(2000, 1000);
  double value = 1.0 / 3;
  a.rolling = MatrixRM::Constant(2, meshes, value *= 0.9);
  for (MatrixRM* x : {&a.bearing_damping, &a.holding_torque})
    *x = MatrixRM::Constant(2, bodies, value *= 0.9);
  a.transmission_error.assign(2, MatrixRM::Constant(4, meshes, 1e-6 / 3));
  a.mesh_deflection.assign(2, MatrixRM::Constant(4, meshes, 1e-6 / 7));
  a.mesh_force.assign(2, MatrixRM::Constant(4, meshes, 1e3 / 3));
  a.pair = Eigen::Vector2i(0, 1);
  a.tooth_load.assign(2, MatrixRM::Constant(4, 2 * meshes, 1e3 / 7));
  a.bearing_force.assign(static_cast<size_t>(bodies),
                         std::vector<MatrixRM>(2, MatrixRM::Constant(4, 2, 1e2 / 3)));
  a.periods = Eigen::Vector2i(20, 30);
  a.period_multiple = Eigen::Vector2i(1, 0);
  for (Eigen::VectorXd* x : {&a.residual, &a.energy_imbalance, &a.drift_force})
    *x = Eigen::Vector2d(1e-6, value *= 0.9);
  a.energy = MatrixRM::Constant(2, static_cast<Eigen::Index>(kEnergyLines.size()), -1.0 / 7);
  a.least_gap = -1e-15;
  a.remarks = remarks_on_carriers(a);
  return a;
}

// What such a sweep may say.
inline whine::ResponseResult small_response(const whine::SystemStaticResult& rest,
                                            whine::Direction direction) {
  using namespace whine;
  const SweepResult sweep = small_sweep(rest, direction);
  ResponseResult r;
  static_cast<MotionSource&>(r) = sweep;
  r.direction = direction;
  r.mesh_frequency = sweep.mesh_frequency;
  r.periods = sweep.periods;
  r.period_multiple = sweep.period_multiple;
  r.energy_imbalance = sweep.energy_imbalance;
  r.remarks = sweep.remarks;
  const Eigen::Index bodies = r.bodies(), meshes = r.meshes();
  double value = 1.0 / 3;
  for (MatrixRM* x : {&r.dte_rms, &r.dte_mean, &r.load_share_max, &r.separation_fraction, &r.mesh_force_max,
                      &r.tooth_load_max, &r.separations_per_period})
    *x = MatrixRM::Constant(2, meshes, value *= 0.9);
  for (MatrixRM* x : {&r.bearing_force_max, &r.bearing_force_rms})
    *x = MatrixRM::Constant(2, bodies, value *= 0.9);
  r.dte_harmonic.assign(2, MatrixRM::Constant(5, meshes, 1e-7 / 3));
  return r;
}
