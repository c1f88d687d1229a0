// The planetary train of Lin and Parker (1999) as a scene, with teeth that can be assembled at equal spacing.
#pragma once
#include <numbers>

#include "model/scene.h"

inline whine::GearDesign rigid_gear(int teeth, bool internal = false, double pressure_angle_deg = 24.6) {
  whine::GearDesign design;
  design.teeth = teeth;
  design.module = 2.776e-3;
  design.pressure_angle = pressure_angle_deg * std::numbers::pi / 180;
  design.addendum = 0.8;
  design.dedendum = 1.15;
  design.rack_tip_radius = 0.2;
  design.face_width = 0.025;
  design.internal = internal;
  if (internal) design.rim_outer_radius = (0.5 * teeth + 5) * design.module;
  return design;
}

// Sun, planets, ring: 27, 36, 99 teeth for three planets, 28, 36, 100 for four, 30, 35, 100 for five.
inline whine::Scene planetary_train(int planets) {
  using namespace whine;
  const std::array<int, 3> teeth = planets == 4   ? std::array{28, 36, 100}
                                   : planets == 5 ? std::array{30, 35, 100}
                                                  : std::array{27, 36, 99};
  Scene scene;
  const auto add = [&](const char* name, int z, bool internal, double equivalent, double mass) {
    SceneGear gear;
    gear.name = name;
    gear.design = rigid_gear(z, internal);
    gear.equivalent_mass = equivalent;
    gear.bearing = {1e8, 0, mass};
    scene.gears.push_back(gear);
  };
  add("sun", teeth[0], false, 0.39, 0.4);
  add("planet", teeth[1], false, 0.61, 0.66);
  add("ring", teeth[2], true, 3.00, 2.35);
  Scene::Carrier carrier;
  carrier.name = "carrier";
  carrier.planet = "planet";
  carrier.planets = planets;
  carrier.equivalent_mass = 6.29;
  carrier.bearing = {1e8, 0, 5.43};
  scene.carriers = {carrier};
  for (const auto& [driver, driven] : {std::pair{"sun", "planet"}, std::pair{"planet", "ring"}}) {
    Scene::Mesh mesh;
    mesh.spec.gear = {driver, driven};
    mesh.spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * 2.776e-3;
    mesh.stiffness = 5e8;
    scene.meshes.push_back(mesh);
  }
  scene.drives = {{"ring", System::DriveKind::held, 0, 1e9}};
  scene.fidelity.body = BodyModel::rigid;
  return scene;
}

// Planets of 27, 36 and 99 teeth at 0, 32, 63 and 95 steps of 1/126 turn: mesh phases that differ.
inline whine::Scene unequal_train() {
  whine::Scene scene = planetary_train(4);
  const std::array teeth{27, 36, 99};
  for (size_t g = 0; g < 3; ++g) scene.gears[g].design = rigid_gear(teeth[g], g == 2);
  for (whine::Scene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * 63 * 2.776e-3;
  scene.carriers[0].planets = 0;
  for (const double angle : {0.0, 91.43, 180.0, 271.43})
    scene.carriers[0].positions.push_back(angle * std::numbers::pi / 180);
  return scene;
}
