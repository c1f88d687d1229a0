// Coarse elastic planetary trains, for tests of systems in motion.
#pragma once
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "gear/system_layout.h"
#include "kept_body.h"
#include "planetary_train.h"
#include "relative.h"
#include "system/system_statics.h"

inline constexpr double kTrainTorque = 300, kTrainModule = 2.776e-3;

inline whine::SystemMotion motion_of(const whine::SystemModel& system, double stiffness,
                                     double eta = 7.7e-6) {
  using namespace whine;
  SystemMotion motion;
  motion.damping.rayleigh_stiffness = eta;
  motion.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  const auto meshes = static_cast<Eigen::Index>(system.mesh.size());
  motion.axis_frequency = axis_frequency(system, stiffness * Eigen::MatrixXd::Identity(meshes, meshes));
  return motion;
}

// Coarse bodies.
inline const whine::ReducedBody& train_body(int teeth, bool internal) {
  using namespace whine;
  GearDesign design = rigid_gear(teeth, internal);
  if (!internal) design.bore_radius = (0.5 * teeth - 5) * kTrainModule;
  return kept_body(design, Material{206e9, 0.3, 7850, true}, 2.5e-3, 15);
}

// Sun, planets and ring; the sun floats, planets stand on elastic pins; ring and carrier are held. change: of the scene.
inline whine::SystemModel train(const std::array<int, 3>& teeth, int planets = 3,
                                const whine::Bearing& of_ring = {},
                                const std::function<void(whine::Scene&)>& change = {}) {
  using namespace whine;
  Scene scene = planetary_train(planets);
  const std::array stiffness{2e7, 3e8, 0.0};
  for (size_t g = 0; g < 3; ++g) {
    SceneGear& gear = scene.gears[g];
    gear.design = rigid_gear(teeth[g], g == 2);
    if (g < 2) gear.design.bore_radius = (0.5 * teeth[g] - 5) * kTrainModule;
    gear.equivalent_mass = 0;
    gear.bearing = {stiffness[g], g == 0 ? 500.0 : 2000.0, 0};
  }
  scene.gears[2].bearing = of_ring;
  scene.carriers[0].bearing = {};
  for (Scene::Mesh& mesh : scene.meshes)
    mesh.spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * kTrainModule;
  scene.drives = {{"sun", System::DriveKind::torque, kTrainTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  if (change) change(scene);
  System layout = layout_of(scene);
  std::vector<ReducedBody> bodies;
  for (System::Body& body : layout.bodies) {
    if (body.kind == System::BodyKind::carrier) continue;
    bodies.push_back(train_body(body.teeth, body.teeth == teeth[2]));
    body.inertia = 1.02 * bodies.back().inertia;
    if (body.bearing.elastic()) body.bearing.mass = bodies.back().mass;
  }
  std::vector<GearMeshSpec> specs;
  for (const System::Mesh& mesh : layout.meshes)
    specs.push_back(scene.meshes[mesh.side[0].body == layout.meshes[0].side[0].body ? 0 : 1].spec);
  return {layout, bodies, specs};
}

// Forces at rest are those of the statics at 16 positions, at 48 of which the motion has its own.
inline void check_rest(whine::SystemDynamics& dynamics, const std::vector<whine::SystemSolution>& statics) {
  for (int i = 0; i < 16; i += 5) {
    const Eigen::VectorXd p = dynamics.rest_forces(3 * i);
    for (int m = 0; m < dynamics.meshes(); ++m) {
      double own = 0;
      for (const whine::LoadedSegment& at : statics[static_cast<size_t>(i)].loads)
        own += at.mesh == m ? at.force : 0;
      CHECK(p.segment(m * dynamics.tooth_pairs(), dynamics.tooth_pairs()).sum() == relative(own, 1e-9));
    }
  }
}

// Tangent of the period map by central differences, along a direction in which no contact changes.
inline void check_tangent(whine::SystemPeriodMap& map, const Eigen::VectorXd& state, Eigen::Index moved) {
  map.apply(state);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(map.size());
  for (Eigen::Index i = 0; i < moved; ++i) along[i] = std::sin(1.0 + static_cast<double>(i));
  const Eigen::MatrixXd slope = map.tangent_times(along);
  constexpr double kStep = 1e-6;
  const Eigen::VectorXd quotient =
      (map.apply(state + kStep * along) - map.apply(state - kStep * along)) / (2 * kStep);
  CHECK((slope - quotient).norm() < 1e-5 * quotient.norm());
}
