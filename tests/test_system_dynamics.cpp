// Systems in motion: the limits of rest and of a pair, energy, periodic motions, what equal planets do to each other.
#include <doctest/doctest.h>

#include <ctime>
#include <cmath>
#include <map>
#include <numbers>

#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "gear/system_layout.h"
#include "io/system_scene.h"
#include "orbits/settle.h"
#include "planetary_train.h"
#include "paper_pair.h"
#include "relative.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;

const BodyArtifact& coarse_body() {
  return paper_body(40e-3, 1.2e-3, 12);
}

// The pair of P2000 as a system whose gears both turn.
SystemModel turning_pair(const std::array<Bearing, 2>& bearing = {}) {
  GearMeshSpec spec = paper_statics(16).mesh;
  spec.bearing = bearing;
  SystemModel system(coarse_body(), coarse_body(), spec);
  system.layout.drives = {{0, System::DriveKind::torque, 150}, {1, System::DriveKind::torque, -150}};
  for (System::Body& body : system.layout.bodies) body.inertia = 0.0148;
  return system;
}

SystemMotion motion_of(const SystemModel& system, double stiffness, double eta = 7.7e-6) {
  SystemMotion motion;
  motion.damping.rayleigh_stiffness = eta;
  motion.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  const auto meshes = static_cast<Index>(system.mesh.size());
  motion.axis_frequency = axis_frequency(system, stiffness * MatrixXd::Identity(meshes, meshes));
  return motion;
}

}  // namespace

TEST_CASE("a pair by the system's equations moves as by those of pairs, on rigid axes and on bearings") {
  for (const bool floats : {false, true}) {
    CAPTURE(floats);
    const std::array<Bearing, 2> bearing =
        floats ? std::array{Bearing{200e6, 500, 0}, Bearing{120e6, 800, 0}} : std::array<Bearing, 2>{};
    const SystemModel system = turning_pair(bearing);
    SystemDynamics dynamics(system, motion_of(system, 463e6));
    constexpr int kSteps = 64;
    dynamics.set_positions({50e-6}, kSteps);
    SystemDynamics::State state = dynamics.rest();

    StaticParameters statics = paper_statics(16);
    statics.mesh.bearing = bearing;
    const GearMeshModel model(coarse_body(), coarse_body(), statics.mesh);
    RollingDynamics pair(model, paper_parameters(463e6, BodyModel::modal, ContactModel::line));
    CandidateZone zone;
    zone.corner_gap = 50e-6;
    pair.set_zone(zone, kSteps);
    RollingDynamics::State rolling = pair.rest();
    SystemDynamics::Period a;
    RollingDynamics::Period b;
    for (const double frequency : {2500.0, 1300.0}) {
      dynamics.set_speed(frequency, kSteps);
      pair.set_speed(frequency, kSteps);
      for (int n = 0; n < 40; ++n) {
        REQUIRE(dynamics.integrate(state, a));
        REQUIRE(pair.integrate(rolling, b));
      }
      SystemEnergyBalance energy;
      EnergyBalance pair_energy;
      REQUIRE(dynamics.integrate(state, a, &energy));
      REQUIRE(pair.integrate(rolling, b, &pair_energy));
      const VectorXd one = a.transmission_error.row(0), other = b.transmission_error;
      const double rms = std::sqrt((other.array() - other.mean()).square().mean());
      // Residual fields of their own, and what other teeth read of them: 12 fields in place of 8.
      CHECK((one - other).norm() < 1e-5 * rms * std::sqrt(static_cast<double>(kSteps)));
      CHECK(a.drift_force == relative(b.drift_force, 1e-4));
      CHECK(energy.imbalance < 1e-12 * energy.throughput);
      CHECK(energy.modal_damping + energy.bearing_damping.sum() == relative(pair_energy.modal_damping, 1e-4));
      CHECK(energy.relaxation_damping == relative(pair_energy.relaxation_damping, 1e-4));
      CHECK(energy.rolling.sum() == relative(pair_energy.rolling, 1e-4));
      CHECK(energy.switching.sum() == relative(pair_energy.switching, 1e-3));
      if (floats) CHECK(energy.bearing_damping.minCoeff() > 0);
    }
  }
}

namespace {

constexpr double kTorque = 300, kModule = 2.776e-3;

// Coarse bodies, each reduced once.
const BodyArtifact& train_body(int teeth, bool internal) {
  static std::map<int, BodyArtifact> known;
  const auto at = known.find(teeth);
  if (at != known.end()) return at->second;
  GearDesign design = rigid_gear(teeth, internal);
  if (!internal) design.bore_radius = (0.5 * teeth - 5) * kModule;
  BodyDiscretisation coarse;
  coarse.element_size = 2.5e-3;
  coarse.modes = 15;
  return known[teeth] = reduce(make_sector_mesh(design, coarse), Material{206e9, 0.3, 7850, true}, coarse.modes);
}

// Sun, planets and ring; the sun floats, planets stand on elastic pins; ring and carrier are held.
SystemModel train(const std::array<int, 3>& teeth, int planets = 3) {
  SystemScene scene = planetary_train(planets);
  const std::array stiffness{2e7, 3e8, 0.0};
  for (size_t g = 0; g < 3; ++g) {
    SystemScene::Gear& gear = scene.gears[g];
    gear.design = rigid_gear(teeth[g], g == 2);
    if (g < 2) gear.design.bore_radius = (0.5 * teeth[g] - 5) * kModule;
    gear.equivalent_mass = 0;
    gear.bearing = {stiffness[g], g == 0 ? 500.0 : 2000.0, 0};
  }
  scene.gears[2].bearing = {};
  scene.carriers[0].bearing = {};
  for (SystemScene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * kModule;
  scene.drives = {{"sun", System::DriveKind::torque, kTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  System layout = on_fixed_carriers(layout_of(scene));
  std::vector<BodyArtifact> bodies;
  for (System::Body& body : layout.bodies) {
    bodies.push_back(train_body(body.teeth, body.teeth == teeth[2]));
    body.inertia = 1.02 * bodies.back().inertia;
  }
  std::vector<GearMeshSpec> specs;
  for (const System::Mesh& mesh : layout.meshes)
    specs.push_back(scene.meshes[mesh.side[0].body == 0 ? 0 : 1].spec);
  return {layout, bodies, specs};
}

}  // namespace

TEST_CASE("at rest the dynamic model of a planetary train is its statics; at low speed its motion is") {
  const SystemModel system = train({26, 37, 100});
  SystemDynamics dynamics(system, motion_of(system, 4e8, 1e-6));
  constexpr int kSteps = 32;
  dynamics.set_positions(std::vector<double>(6, 60e-6), kSteps);
  const std::vector<SystemSolution> statics = rest_over_period(system, ContactModel::line, 8, kSteps);
  const double load = 300 / system.base_radius(0) / 3;
  for (int i = 0; i < kSteps; i += 5) {
    const VectorXd p = dynamics.rest_forces(i);
    double total = 0;
    for (const LoadedSegment& at : statics[static_cast<size_t>(i)].loads) total += at.force;
    MESSAGE("" << p.sum() << " " << total);
    for (int m = 0; m < 6; ++m) {
      double own = 0;
      for (const LoadedSegment& at : statics[static_cast<size_t>(i)].loads) own += at.mesh == m ? at.force : 0;
      CHECK(p.segment(m * dynamics.pairs(), dynamics.pairs()).sum() == relative(own, 1e-6));
    }
  }
  SystemDynamics::Period period;
  for (const int steps : {256, 512}) {
    SystemDynamics slow(system, motion_of(system, 4e8, 1e-6));
    slow.set_positions(std::vector<double>(6, 60e-6), steps);
    SystemDynamics::State state = slow.rest();
    for (const double frequency : {80.0, 40.0}) {
    slow.set_speed(frequency, steps);
    for (int n = 0; n < 3; ++n) REQUIRE(slow.integrate(state, period));
    double worst = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int m = 0; m < 6; ++m)
        worst = std::max(worst, std::abs(period.transmission_error(m, i * steps / kSteps) -
                                         statics[static_cast<size_t>(i)].transmission_error[static_cast<size_t>(m)]));
    MESSAGE("" << steps << " " << frequency << " Hz: " << worst << " m of " << statics[0].transmission_error[0] << " load " << load);
    }
  }
  SystemDynamics::State state = dynamics.rest();
  SystemEnergyBalance energy;
  for (const double f : {1000., 2000., 2500., 3000., 4000., 5000., 6000., 7000., 8000.}) {
  dynamics.set_speed(f, kSteps);
  const auto from = std::clock();
  for (int n = 0; n < 100; ++n) REQUIRE(dynamics.integrate(state, period));
  const double us = 1e6 * static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC;
  REQUIRE(dynamics.integrate(state, period, &energy));
  double rms = 0;
  for (int m = 0; m < 6; ++m) rms = std::max(rms, std::sqrt((period.transmission_error.row(m).array() - period.transmission_error.row(m).mean()).square().mean()));
  MESSAGE("" << f << " Hz " << us / 100 / kSteps << " us a step, " << dynamics.most_contacts() << " contacts, " << dynamics.coordinates().size() << " coordinates, relaxed " << dynamics.relaxed_size() << " imbalance " << energy.imbalance/energy.throughput << " rms " << rms*1e6 << " least mesh force " << period.mesh_force.minCoeff());
  }
}
