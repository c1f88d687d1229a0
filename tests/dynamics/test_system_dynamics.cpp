// Systems in motion: the limits of rest and of a pair, energy, periodic motions, what equal planets do to each other.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <ctime>
#include <memory>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "gear/system_layout.h"
#include "gear/train.h"
#include "memory.h"
#include "orbits/periodic_motion.h"
#include "orbits/periodic_orbit.h"
#include "paper_pair.h"
#include "relative.h"
#include "signal/spectrum.h"
#include "system/rigid_system.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;

const ReducedBody& coarse_body() {
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
      EnergyBalance energy;
      EnergyBalance pair_energy;
      energy = {};
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
      CHECK(energy.rolling.sum() == relative(pair_energy.rolling[0], 1e-4));
      CHECK(energy.switching.sum() == relative(pair_energy.switching[0], 1e-3));
      if (floats) CHECK(energy.bearing_damping.minCoeff() > 0);
    }
  }
}

namespace {

constexpr double kTorque = kTrainTorque, kModule = kTrainModule;

}  // namespace

namespace {

constexpr int kSteps = 48;  // threes, over which planets hand their motion on

// A planet of 37 teeth and a ring of 100 as a system on rigid axes. sense: of the driver.
SystemModel internal_pair(bool ring_drives, int sense) {
  const std::array<int, 2> teeth = ring_drives ? std::array{100, 37} : std::array{37, 100};
  std::array<GearDesign, 2> design;
  for (size_t g = 0; g < 2; ++g) design[g] = train_body(teeth[g], teeth[g] == 100).design;
  GearMeshSpec spec;
  spec.gear = {"a", "b"};
  spec.centre_distance = 31.5 * kModule;
  System layout;
  add_input_gear(layout, "a", design[0]);
  layout.bodies[0].sense = sense;
  add_driven_gear(layout, 0, design[0], "b", design[1], spec.centre_distance, 0.7);
  const std::vector<ReducedBody> bodies = {train_body(teeth[0], ring_drives),
                                           train_body(teeth[1], !ring_drives)};
  const double torque = teeth[0] * kTorque / 26;
  layout.drives = {{0, System::DriveKind::torque, torque},
                   {1, System::DriveKind::torque, -torque * teeth[1] / teeth[0]}};
  for (size_t b = 0; b < 2; ++b) layout.bodies[b].inertia = 1.3 * bodies[b].inertia;
  return {layout, bodies, {spec}};
}

// Three equal planets, 26, 37 and 100 teeth: a third of a mesh period apart.
struct Planetary {
  explicit Planetary(double eta = 1e-6, int steps = kSteps, double gap = 60e-6, const Bearing& of_ring = {})
      : system(train({26, 37, 100}, 3, of_ring)), dynamics(system, motion_of(system, 4e8, eta)) {
    dynamics.set_positions(std::vector<double>(6, gap), steps);
  }
  SystemModel system;
  SystemDynamics dynamics;
};

Planetary& planetary() {
  static Planetary out;
  return out;
}

}  // namespace

TEST_CASE(
    "a planetary train: forces at rest are those of its statics, and so is slow motion, to the first order of the speed") {
  Planetary& rig = planetary();
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, 16);
  check_rest(rig.dynamics, statics);
  constexpr int kFine = 192;
  Planetary slow(1e-6, kFine);
  SystemDynamics::State state = slow.dynamics.rest();
  SystemDynamics::Period period;
  std::vector<double> off;
  for (const double frequency : {80.0, 40.0, 20.0}) {
    slow.dynamics.set_speed(frequency, kFine);
    for (int n = 0; n < 3; ++n) REQUIRE(slow.dynamics.integrate(state, period));
    off.push_back(0);
    for (int i = 0; i < 16; ++i)
      for (int m = 0; m < 6; ++m)
        off.back() = std::max(
            off.back(), std::abs(period.transmission_error(m, i * kFine / 16) -
                                 statics[static_cast<size_t>(i)].transmission_error[static_cast<size_t>(m)]));
  }
  CHECK(off[0] < 0.003 * statics[0].transmission_error[0]);
  CHECK(off[1] < 0.55 * off[0]);
  CHECK(off[2] < 0.55 * off[1]);
}

// Planets then work on one flank with the ring and on the other with the sun.
TEST_CASE("a planetary train that the ring drives: forces at rest of the motion are those of its statics") {
  const SystemModel system = train({26, 37, 100}, 3, {}, [](Scene& scene) {
    scene.drives = {{"ring", System::DriveKind::torque, kTorque, 0},
                    {"sun", System::DriveKind::held, 0, 0},
                    {"carrier", System::DriveKind::held, 0, 0}};
    for (Scene::Mesh& mesh : scene.meshes) std::swap(mesh.spec.gear[0], mesh.spec.gear[1]);
    std::swap(scene.meshes[0], scene.meshes[1]);
  });
  int both = 0;
  for (const System::Mesh& a : system.layout.meshes)
    for (const System::Mesh& b : system.layout.meshes)
      for (const auto& of_a : a.side)
        for (const auto& of_b : b.side) both += of_a.body == of_b.body && of_a.flank != of_b.flank;
  CHECK(both > 0);
  SystemDynamics dynamics(system, motion_of(system, 4e8));
  dynamics.set_positions(std::vector<double>(6, 60e-6), kSteps);
  check_rest(dynamics, rest_over_period(system, ContactModel::line, 8, 16));
}

TEST_CASE("a planetary train that loses contact: energy closes, p . d and dropped loads included") {
  SystemDynamics& dynamics = planetary().dynamics;
  SystemDynamics::State state = dynamics.rest();
  SystemDynamics::Period period;
  EnergyBalance energy;
  dynamics.set_speed(7000, kSteps);
  for (int n = 0; n < 30; ++n) REQUIRE(dynamics.integrate(state, period));
  const long before = memory_requests;
  REQUIRE(dynamics.integrate(state, period));
  CHECK(memory_requests == before);
  int parted = 0;
  for (int n = 0; n < 5; ++n) {
    energy = {};
    REQUIRE(dynamics.integrate(state, period, &energy));
    parted += static_cast<int>((period.mesh_force.array() == 0).count());
    CHECK(energy.imbalance < 1e-12 * energy.throughput);
    CHECK(std::abs(energy.dropped) < 1e-9 * energy.throughput);
    CHECK(energy.cutting.cwiseAbs().sum() < 1e-9 * energy.throughput);
    CHECK(period.least_gap > -1e-13);
  }
  CHECK(parted > 0);
  CHECK(energy.bearing_damping.head(4).minCoeff() > 0);
  CHECK(energy.relaxation_damping > 0);
}

TEST_CASE(
    "a planetary train is a period map: tangent, periodic motion, orbit, and what equal planets suppress") {
  SystemDynamics& dynamics = planetary().dynamics;
  SystemPeriodMap map(dynamics, kSteps);
  map.set_parameter(2600);
  const PeriodicMotion plain = iterate_to_orbit(map, map.rest(), {1e-10, 3000, false}),
                       quick = iterate_to_orbit(map, map.rest(), {1e-10, 3000, true});
  REQUIRE(plain.multiple == 1);
  REQUIRE(quick.multiple == 1);
  CHECK(quick.turns < plain.turns);
  CHECK((plain.state - quick.state).norm() < 1e-7);
  check_tangent(map, quick.state, 2 * dynamics.coordinates().size());
  const OrbitSearch orbit = newton_orbit(map, plain.state, 1, {1e-9, 25});
  INFO(orbit.failure);
  CHECK(orbit.found());
  CHECK((orbit.orbit.start - quick.state).norm() < 1e-7);
  CHECK(orbit.orbit.multipliers().cwiseAbs()[0] < 1);

  // z_s / N is not whole: harmonic l turns the sun only where z_s l / N is, and pushes its bearing only where it is not.
  map.apply(quick.state);
  const SystemDynamics::Period& period = map.period();
  const VectorXd turn = period.transmission_error.topRows(3).colwise().sum(),
                 push = period.bearing_force[0].row(0);
  const Harmonics turns = harmonics(turn, 6), pushes = harmonics(push, 6);
  double most_turn = turns.amplitude.maxCoeff(), most_push = pushes.amplitude.maxCoeff();
  for (const int l : {1, 2, 4, 5}) {
    CHECK(turns.amplitude[l - 1] < 1e-6 * most_turn);
    CHECK(pushes.amplitude[l - 1] > 1e-3 * most_push);
  }
  for (const int l : {3, 6}) CHECK(pushes.amplitude[l - 1] < 1e-6 * most_push);
  CHECK(most_turn > 1e-8);
  CHECK(most_push > 1);
}

TEST_CASE("frozen contact: the lowest natural frequencies are those of the train of rigid bodies") {
  Planetary& rig = planetary();
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, 16);
  for (const int i : {0, 3}) {
    const VectorXd own = rig.dynamics.frozen_frequencies(3 * i);
    const RigidSystem rigid = rigid_system(rig.system.layout, statics[static_cast<size_t>(i)].mesh_stiffness);
    const SymmetricEigen eigen = symmetric_eigenvalues(
        MatrixXd(rigid.mass.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() * rigid.stiffness *
                 rigid.mass.diagonal().cwiseSqrt().cwiseInverse().asDiagonal()));
    const VectorXd other = eigen.values.cwiseMax(0.0).cwiseSqrt() / (2 * kPi);
    for (Index n = 0; n < 5; ++n) {
      CHECK(own[n] == relative(other[n], 0.003));
    }
  }
}

// From outside: rigid gears on springs, M x" + C x' + K x = K x_s(t) with K of the mean mesh stiffnesses and x_s(t) the displacements
// of the statics, harmonic by harmonic; C that of the bearings and eta times the meshes. It leaves out what the
// stiffness varies by and the inertia of what deforms: a few percent where neither is near a resonance.
TEST_CASE("planets in motion, both flanks: the forced response of rigid gears on springs") {
  Planetary& rig = planetary();
  constexpr int kPhases = 48;
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, kPhases);
  MatrixXd mean = MatrixXd::Zero(6, 6);
  for (const SystemSolution& at : statics) mean += at.mesh_stiffness / kPhases;
  const RigidSystem rigid = rigid_system(rig.system.layout, mean);
  // Loads that hold the displacements of rest on the springs, from the meshes' own deflections and the bearings.
  const Index freedoms = rigid.freedoms();
  MatrixXd at_rest = MatrixXd::Zero(freedoms, kPhases);
  for (int i = 0; i < kPhases; ++i) {
    const SystemSolution& at = statics[static_cast<size_t>(i)];
    for (size_t b = 0; b < rig.system.body.size(); ++b) {
      const auto column = static_cast<Index>(b);
      at_rest.col(i) += rigid.rotation[b].transpose() * at.equilibrium.x[column];
      if (const Bearing& bearing = rig.system.layout.bodies[b].bearing; bearing.elastic())
        at_rest.col(i) += rigid.translation[b].transpose() * (at.bearing_force[b] / bearing.stiffness);
    }
  }
  MatrixXd damping = 1e-6 * rigid.closing.transpose() * rigid.mesh_stiffness * rigid.closing;
  for (size_t b = 0; b < rig.system.body.size(); ++b)
    damping +=
        rig.system.layout.bodies[b].bearing.damping * rigid.translation[b].transpose() * rigid.translation[b];
  constexpr double kFrequency = 1200;
  constexpr int kHarmonics = 3;
  MatrixXd forced = MatrixXd::Zero(6, kPhases), still = forced;
  for (int i = 0; i < kPhases; ++i)
    for (Index m = 0; m < 6; ++m)
      still(m, i) = statics[static_cast<size_t>(i)].transmission_error[static_cast<size_t>(m)];
  // Rows of the transmission errors: rotations alone.
  MatrixXd error = MatrixXd::Zero(6, freedoms);
  for (int m = 0; m < 6; ++m)
    for (int s = 0; s < 2; ++s)
      error.row(m) +=
          closing_sign(s) *
          rigid.rotation[static_cast<size_t>(
              rig.system.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(s)].body)];
  for (int l = 1; l <= kHarmonics; ++l) {
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(freedoms);
    for (int i = 0; i < kPhases; ++i)
      x += std::polar(2.0 / kPhases, -2 * kPi * l * i / kPhases) * at_rest.col(i);
    const double w = 2 * kPi * l * kFrequency;
    Eigen::MatrixXcd dynamic = (rigid.stiffness - w * w * rigid.mass).cast<std::complex<double>>();
    dynamic += std::complex<double>(0, w) * damping;
    const Eigen::VectorXcd y = least_squares(dynamic, Eigen::MatrixXcd(rigid.stiffness * x));
    for (int i = 0; i < kPhases; ++i)
      forced.col(i) += (error * (y * std::polar(1.0, 2 * kPi * l * i / kPhases)).real());
  }
  const auto rms = [](const Eigen::RowVectorXd& of) {
    return std::sqrt((of.array() - of.mean()).square().mean());
  };
  SystemPeriodMap map(rig.dynamics, kSteps);
  map.set_parameter(kFrequency);
  const PeriodicMotion motion = iterate_to_orbit(map, map.rest(), {1e-6, 3000, true});
  REQUIRE(motion.multiple == 1);
  map.apply(motion.state);
  for (Index m = 0; m < 6; ++m) {
    const double dynamic = rms(map.period().transmission_error.row(m)), quasi = rms(still.row(m));
    CAPTURE(m);
    CAPTURE(dynamic / quasi);
    CHECK(dynamic == relative(rms(forced.row(m)), 0.05));
  }
}

TEST_CASE("a third gear without torque: the first two move as a pair") {
  const std::array<int, 3> teeth{26, 37, 26};
  const auto gears = [&](size_t count) {
    System layout;
    const double distance = 0.5 * 63 * kModule;
    GearDesign design = rigid_gear(26);
    design.bore_radius = 8 * kModule;
    GearDesign idler = rigid_gear(37);
    idler.bore_radius = 13.5 * kModule;
    add_input_gear(layout, "a", design);
    add_driven_gear(layout, 0, design, "b", idler, distance, 0.3);
    if (count == 3) add_driven_gear(layout, 1, idler, "c", design, distance, 1.5);
    layout.drives = {{0, System::DriveKind::torque, kTorque},
                     {1, System::DriveKind::torque, -kTorque * 37 / 26}};
    std::vector<ReducedBody> bodies;
    std::vector<GearMeshSpec> specs;
    for (size_t b = 0; b < count; ++b) {
      bodies.push_back(train_body(teeth[b], false));
      layout.bodies[b].inertia = 1.5 * bodies.back().inertia;
    }
    for (size_t m = 0; m + 1 < count; ++m) {
      GearMeshSpec spec;
      spec.gear = {layout.bodies[m].name, layout.bodies[m + 1].name};
      spec.centre_distance = distance;
      // Tip edges act with lever arms of their own, and would roll the two gears away from the third.
      spec.corner.enabled = false;
      specs.push_back(spec);
    }
    return SystemModel(layout, bodies, specs);
  };
  const SystemModel pair = gears(2), idler = gears(3);
  SystemMotion motion = motion_of(pair, 4e8, 3e-6);
  motion.damping.bearing_ratio = 0.02;
  SystemDynamics one(pair, motion), three(idler, motion);
  one.set_positions({60e-6}, kSteps);
  three.set_positions({60e-6, 60e-6}, kSteps);
  SystemDynamics::State a = one.rest(), b = three.rest();
  SystemDynamics::Period p, q;
  one.set_speed(2600, kSteps);
  three.set_speed(2600, kSteps);
  for (int n = 0; n < 400; ++n) {
    REQUIRE(one.integrate(a, p));
    REQUIRE(three.integrate(b, q));
  }
  CHECK(q.mesh_force.row(1).maxCoeff() == 0);
  // An idler has the fields of both its flanks.
  CHECK((p.transmission_error.row(0) - q.transmission_error.row(0)).norm() <
        1e-5 * p.transmission_error.row(0).norm());
  CHECK(q.drift_force < 1e-9 * kTorque / pair.base_radius(0));
}

TEST_CASE("stiff bearings: rigid axes, to the first order of their flexibility") {
  const auto errors = [&](double stiffness) {
    std::array<Bearing, 2> bearing;
    if (stiffness > 0)
      bearing = {Bearing{stiffness, 0.02 * std::sqrt(stiffness), 0},
                 Bearing{stiffness, 0.02 * std::sqrt(stiffness), 0}};
    const SystemModel system = turning_pair(bearing);
    SystemDynamics dynamics(system, motion_of(system, 463e6));
    dynamics.set_positions({50e-6}, 64);
    SystemDynamics::State state = dynamics.rest();
    SystemDynamics::Period period;
    dynamics.set_speed(1300, 64);
    for (int n = 0; n < 60; ++n) REQUIRE(dynamics.integrate(state, period));
    return VectorXd(period.transmission_error.row(0));
  };
  const VectorXd rigid = errors(0);
  const double one = (errors(4e11) - rigid).norm() / rigid.norm(),
               two = (errors(8e11) - rigid).norm() / rigid.norm();
  CHECK(one < 0.01);
  CHECK(two / one == relative(0.5, 0.05));
}

TEST_CASE(
    "an internal pair by the system's equations moves as by those of pairs, in both senses, either driver") {
  for (const bool ring_drives : {false, true}) {
    const SystemModel reference = internal_pair(ring_drives, 1);
    DynamicParameters parameters = paper_parameters(4e8, BodyModel::modal, ContactModel::line);
    parameters.torque = reference.layout.torque(0);
    parameters.inertia = {reference.layout.bodies[0].inertia, reference.layout.bodies[1].inertia};
    GearMeshSpec spec;
    spec.gear = {"a", "b"};
    spec.centre_distance = 31.5 * kModule;
    const GearMeshModel model(reference.body[0]->body(), reference.body[1]->body(), spec);
    RollingDynamics pair(model, parameters);
    CandidateZone zone;
    zone.corner_gap = 60e-6;
    pair.set_zone(zone, kSteps);
    RollingDynamics::State rolling = pair.rest();
    RollingDynamics::Period b;
    pair.set_speed(2500, kSteps);
    for (int n = 0; n < 60; ++n) REQUIRE(pair.integrate(rolling, b));
    const VectorXd other = b.transmission_error;
    const double rms = std::sqrt((other.array() - other.mean()).square().mean());
    for (const int sense : {1, -1}) {
      CAPTURE(ring_drives);
      CAPTURE(sense);
      const SystemModel system = internal_pair(ring_drives, sense);
      SystemDynamics dynamics(system, motion_of(system, 4e8));
      dynamics.set_positions({60e-6}, kSteps);
      SystemDynamics::State state = dynamics.rest();
      SystemDynamics::Period a;
      dynamics.set_speed(2500, kSteps);
      for (int n = 0; n < 60; ++n) REQUIRE(dynamics.integrate(state, a));
      const VectorXd one = a.transmission_error.row(0);
      CHECK((one - other).norm() < 1e-4 * rms * std::sqrt(static_cast<double>(kSteps)));
      CHECK(a.drift_force == relative(b.drift_force, 1e-3));
    }
  }
}

TEST_CASE("a ring that floats on a bearing: rest, frozen modes, energy, and the rigid axis as its limit") {
  const Bearing soft{4e7, 3000, 0};
  Planetary rig(1e-6, kSteps, 60e-6, soft);
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, 16);
  const int ring = static_cast<int>(rig.system.body.size()) - 1;
  REQUIRE(is_ring(rig.system.layout, ring));
  check_rest(rig.dynamics, statics);
  const auto ring_rigid = [&](int i) {
    const RigidSystem rigid = rigid_system(rig.system.layout, statics[static_cast<size_t>(i)].mesh_stiffness);
    const MatrixXd unit = rigid.mass.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    return VectorXd(
        symmetric_eigenvalues(MatrixXd(unit * rigid.stiffness * unit)).values.cwiseMax(0.0).cwiseSqrt() /
        (2 * kPi));
  };
  for (const int i : {0, 3}) {
    const VectorXd own = rig.dynamics.frozen_frequencies(3 * i), other = ring_rigid(i);
    for (Index n = 0; n < 7; ++n) {
      CAPTURE(n);
      CHECK(own[n] == relative(other[n], 0.005));
    }
  }
  SystemPeriodMap map(rig.dynamics, kSteps);
  map.set_parameter(2600);
  const PeriodicMotion motion = iterate_to_orbit(map, map.rest(), {1e-9, 3000, true});
  REQUIRE(motion.multiple == 1);
  map.apply(motion.state);
  // Phases of planets cancel on the ring as on the sun.
  const Harmonics pushes =
      harmonics(VectorXd(map.period().bearing_force[static_cast<size_t>(ring)].row(0)), 6);
  for (const int l : {3, 6}) CHECK(pushes.amplitude[l - 1] < 1e-6 * pushes.amplitude.maxCoeff());
  CHECK(pushes.amplitude.maxCoeff() > 1);
  SystemDynamics::State state = rig.dynamics.rest();
  SystemDynamics::Period period;
  rig.dynamics.set_speed(7000, kSteps);
  for (int n = 0; n < 30; ++n) REQUIRE(rig.dynamics.integrate(state, period));
  EnergyBalance energy;
  energy = {};
  REQUIRE(rig.dynamics.integrate(state, period, &energy));
  CHECK(energy.imbalance < 1e-12 * energy.throughput);
  CHECK(energy.bearing_damping[ring] > 0);

  const auto errors = [&](const Bearing& bearing) {
    Planetary on(1e-6, kSteps, 60e-6, bearing);
    SystemDynamics::State from = on.dynamics.rest();
    on.dynamics.set_speed(2600, kSteps);
    for (int n = 0; n < 80; ++n) REQUIRE(on.dynamics.integrate(from, period));
    return MatrixXd(period.transmission_error);
  };
  const MatrixXd rigid = errors({});
  // To the first order of their flexibility; between neighbours of a factor of 2 a contact that changes a step earlier hides it.
  const double soft_one = (errors({1.6e11, 2e4, 0}) - rigid).norm() / rigid.norm(),
               stiff_one = (errors({1.6e12, 2e4, 0}) - rigid).norm() / rigid.norm();
  CHECK(soft_one < 1e-4);
  CHECK(stiff_one == relative(0.1 * soft_one, 0.1));
}

namespace {

// CPU seconds of a step, by 100 mesh periods at 2500 Hz.
double step_time(SystemDynamics& dynamics) {
  SystemDynamics::State state = dynamics.rest();
  SystemDynamics::Period period;
  dynamics.set_speed(2500, kSteps);
  constexpr int kPeriods = 100;
  const auto from = std::clock();
  for (int n = 0; n < kPeriods; ++n) REQUIRE(dynamics.integrate(state, period));
  return static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC / (kPeriods * kSteps);
}

}  // namespace

// CPU time of a step over the number of meshes, and with a carrier that moves over one that is held; the numbers of
// common/dynamics/README.md:
//   build/bin/whine-tests --no-skip -tc='time of a step of planetary trains*'
TEST_CASE("time of a step of planetary trains over the number of meshes" * doctest::skip()) {
  for (const int planets : {1, 2, 3}) {
    const SystemModel system = train({27, 36, 99}, planets);
    SystemDynamics dynamics(system, motion_of(system, 4e8, 2e-6));
    dynamics.set_positions(std::vector<double>(system.mesh.size(), 40e-6), kSteps);
    MESSAGE(text(system.mesh.size(), " meshes, ", dynamics.most_contacts(), " pairs in reach, ",
                 dynamics.coordinates().size(), " coordinates: ", step_time(dynamics) * 1e6, " us a step"));
  }
  struct Rig {
    const char* carrier;
    SystemModel system;
    double least = 1;
    std::unique_ptr<SystemDynamics> dynamics = {};
  };
  const auto with = [](bool turns, double stiffness, bool pins) {
    return train({27, 36, 99}, 3, {}, [=](Scene& scene) {
      if (turns) scene.drives[2] = {"carrier", System::DriveKind::torque, -kTrainTorque * (1 + 99.0 / 27), 0};
      if (stiffness > 0) scene.carriers[0].bearing = {stiffness, 4000, 5.43};
      if (!pins) scene.gears[1].bearing = {};
    });
  };
  std::vector<Rig> rigs;
  rigs.push_back({"held", with(false, 0, true)});
  rigs.push_back({"turns", with(true, 0, true)});
  rigs.push_back({"turns on a bearing", with(true, 1e8, true)});
  rigs.push_back({"turns on a bearing, rigid pins", with(true, 1e8, false)});
  for (Rig& rig : rigs) {
    rig.dynamics = std::make_unique<SystemDynamics>(rig.system, motion_of(rig.system, 4e8, 2e-6));
    rig.dynamics->set_positions(std::vector<double>(6, 40e-6), kSteps);
  }
  for (int round = 0; round < 7; ++round)  // in turn: the machine has other work
    for (Rig& rig : rigs) rig.least = std::min(rig.least, step_time(*rig.dynamics));
  for (const Rig& rig : rigs)
    MESSAGE(text("carrier ", rig.carrier, ", ", rig.dynamics->most_contacts(), " pairs in reach, ",
                 rig.dynamics->coordinates().size(), " coordinates: ", rig.least * 1e6, " us a step, ",
                 rig.least / rigs[0].least, " times the one that is held"));
}
