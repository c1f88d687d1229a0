// Elastic planetary trains whose carrier turns or moves on bearings: any member held, rest, frozen modes, motion.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "orbits/periodic_motion.h"
#include "refusal.h"
#include "relative.h"
#include "signal/spectrum.h"
#include "studies/turning_carrier.h"
#include "system/rigid_system.h"
#include "system/system_rest.h"
#include "system/system_statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::array<int, 3> kTeeth{26, 37, 100};
constexpr double kOfRing = kTrainTorque * 100 / 26, kOfCarrier = kTrainTorque * 126 / 26;
constexpr int kSteps = 48;                 // threes, over which planets hand their motion on
constexpr size_t kRing = 4, kCarrier = 5;  // bodies of a train of three planets

using Drives = std::vector<Scene::Drive>;
const System::DriveKind kTorque = System::DriveKind::torque, kHeld = System::DriveKind::held;
const Drives kCarrierTurns = {
    {"sun", kTorque, kTrainTorque, 0}, {"ring", kHeld, 0, 0}, {"carrier", kTorque, -kOfCarrier, 0}};

// stiffness_of_carrier: N m-1 of its bearing; 0: a rigid axis.
SystemModel train_with(const Drives& drives, double stiffness_of_carrier = 0, bool corner = true,
                       bool elastic_pins = true, double inertia_factor = 1) {
  return train(kTeeth, 3, {}, [&](Scene& scene) {
    scene.drives = drives;
    if (stiffness_of_carrier > 0) scene.carriers[0].bearing = {stiffness_of_carrier, 4000, 5.43};
    if (!elastic_pins) scene.gears[1].bearing = {};
    scene.carriers[0].equivalent_mass *= inertia_factor;
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.corner.enabled = corner;
  });
}

struct Moving {
  explicit Moving(SystemModel of, double eta = 1e-6)
      : system(std::move(of)), dynamics(system, motion_of(system, 4e8, eta)) {
    dynamics.set_positions(std::vector<double>(6, 60e-6), kSteps);
  }
  SystemModel system;
  SystemDynamics dynamics;
};

// The carrier turns, on an elastic bearing.
Moving& turning() {
  static Moving out(train_with(kCarrierTurns, 2e8));
  return out;
}

}  // namespace

TEST_CASE("a train that turns as one rigid body closes no gap, whatever carries its planets") {
  for (const bool pins : {true, false}) {
    const SystemModel system = train_with(kCarrierTurns, 0, true, pins);
    VectorXd turned(6);
    for (int b = 0; b < 6; ++b)
      turned[b] = system.layout.bodies[static_cast<size_t>(b)].sense * system.base_radius(b);
    const RigidSystem rigid = rigid_system(system.layout, 4e8 * MatrixXd::Identity(6, 6));
    CHECK((closing_of(system.layout).transpose() * turned).norm() < 1e-12 * turned.norm());
    for (size_t m = 0; m < 6; ++m)
      REQUIRE(carried_mesh(system.layout, m).carrier == static_cast<int>(kCarrier));
    // The assembly of rigid bodies has the same rows, the held ring left out; on rigid pins it knows no translation of planets.
    VectorXd q = VectorXd::Zero(rigid.freedoms());
    for (size_t b = 0; b < 6; ++b) q += rigid.rotation[b].transpose() * turned[static_cast<Index>(b)];
    if (!pins) CHECK((rigid.closing * q).head(3).norm() < 1e-12 * turned.norm());
    // Of the strips, tip edges among them.
    SystemStatics statics(system, ContactModel::line, static_zones(system, 8, 1, 1));
    for (const double phase : {0.0, 0.3, 0.8}) {
      statics.solve(phase, 0, VectorXd::Zero(6));
      CHECK((statics.position().displacement.rotation * turned).cwiseAbs().maxCoeff() <
            1e-10 * turned.maxCoeff());
    }
  }
}

TEST_CASE("which member is held makes no difference to loads, errors and pins at rest") {
  const auto solutions = [](const Drives& drives, double stiffness, bool corner) {
    return rest_over_period(train_with(drives, stiffness, corner), ContactModel::line, 8, 6);
  };
  const Drives carrier_held = {
      {"sun", kTorque, kTrainTorque, 0}, {"ring", kHeld, 0, 0}, {"carrier", kHeld, 0, 0}};
  const std::vector<Drives> others = {
      kCarrierTurns,
      {{"sun", kHeld, 0, 0}, {"ring", kTorque, -kOfRing, 0}, {"carrier", kTorque, -kOfCarrier, 0}},
      {{"sun", kHeld, 0, 0}, {"ring", kHeld, 0, 0}, {"carrier", kTorque, -kOfCarrier, 0}},
      {{"sun", kTorque, kTrainTorque, 0}, {"ring", kTorque, -kOfRing, 0}, {"carrier", kHeld, 0, 0}},
      {{"sun", kTorque, kTrainTorque, 0},
       {"ring", kTorque, -kOfRing, 0},
       {"carrier", kTorque, -kOfCarrier, 0}}};
  for (const double stiffness : {0.0, 2e8}) {
    const auto one = solutions(carrier_held, stiffness, false);
    for (size_t n = 0; n < others.size(); ++n) {
      CAPTURE(n);
      const auto two = solutions(others[n], stiffness, false);
      for (size_t i = 0; i < one.size(); ++i)
        for (size_t m = 0; m < 6; ++m) {
          CHECK(two[i].driving_force[m] == relative(one[i].driving_force[m], 1e-8));
          CHECK(two[i].transmission_error[m] == relative(one[i].transmission_error[m], 1e-8));
          CHECK(two[i].deflection[m] == relative(one[i].deflection[m], 1e-8));
          const auto b = m % 3 + 1;
          CHECK((two[i].bearing_force[b] - one[i].bearing_force[b]).norm() <
                1e-8 * one[i].bearing_force[b].norm());
        }
    }
  }
  // Tip edges act with lever arms of their own: what would turn the train as a whole is taken out.
  const auto one = solutions(carrier_held, 0, true), two = solutions(kCarrierTurns, 0, true);
  for (size_t i = 0; i < one.size(); ++i)
    for (size_t m = 0; m < 6; ++m)
      CHECK(two[i].transmission_error[m] == relative(one[i].transmission_error[m], 0.01));
}

TEST_CASE(
    "torques that are not balanced: the one that would balance the others is named, digits are forgiven") {
  const auto with = [](double of_carrier) {
    Drives drives = kCarrierTurns;
    drives[2].torque = of_carrier;
    return load_balance(train_with(drives).layout);
  };
  CHECK(with(-1453.8462).balanced);
  CHECK(!with(-1453).balanced);
  CHECK(with(-1453.8462).load.sum() == relative(with(-kOfCarrier).load.sum(), 1e-6));
  Drives drives = kCarrierTurns;
  drives.pop_back();
  CHECK(names(message_of([&] { mesh_loads(train_with(drives)); }), {"carrier", 0, "-1453.846154"}));
}

TEST_CASE(
    "frozen stiffness of a train on its carrier: assembly of the modes and tangent of the statics agree") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const SystemModel system = train_with(
        {{"sun", kHeld, 0, 0}, {"ring", kHeld, 0, 0}, {"carrier", kTorque, -kOfCarrier, 0}}, 2e8, false);
    for (const SystemSolution& at : rest_over_period(system, contact, 4, 2)) {
      const RigidSystem rigid = rigid_system(system.layout, at.mesh_stiffness);
      std::vector<Index> turns, moves;
      for (Index q = 0; q < rigid.freedoms(); ++q) {
        bool turn = false;
        for (const MatrixXd& u : rigid.rotation) turn = turn || u(0, q) != 0;
        (turn ? turns : moves).push_back(q);
      }
      REQUIRE(turns.size() == 4);   // planets and carrier
      REQUIRE(moves.size() == 10);  // of sun, planets and carrier
      const MatrixXd& k = rigid.stiffness;
      const MatrixXd condensed =
          k(turns, turns) - k(turns, moves) * k(moves, moves).ldlt().solve(k(moves, turns));
      CHECK((condensed - at.equilibrium.stiffness).norm() < 1e-8 * condensed.norm());
    }
  }
}

TEST_CASE("a carrier that turns: frozen contact has the natural frequencies of the train of rigid bodies") {
  // Of tip edges what is left of the moments is spread otherwise than by the inertias of motion.
  Moving rig(train_with(kCarrierTurns, 2e8, false));
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, 16);
  check_rest(rig.dynamics, statics);
  for (const int i : {0, 3}) {
    const VectorXd own = rig.dynamics.frozen_frequencies(3 * i);
    const RigidSystem rigid = rigid_system(rig.system.layout, statics[static_cast<size_t>(i)].mesh_stiffness);
    const VectorXd other = symmetric_eigen(rigid.stiffness, rigid.mass).values.cwiseMax(0.0).cwiseSqrt() /
                           (2 * std::numbers::pi);
    CHECK(other[0] < 1e-3 * other[1]);  // the rolling of the train, which is no coordinate of its motion
    for (Index n = 0; n < 7; ++n) {
      CAPTURE(n);
      CHECK(own[n] == relative(other[n + 1], 0.006));
    }
  }
}

TEST_CASE("a carrier that turns, contact lost: energy closes, its bearing takes a part") {
  SystemDynamics& dynamics = turning().dynamics;
  SystemDynamics::State state = dynamics.rest();
  SystemDynamics::Period period;
  EnergyBalance energy;
  dynamics.set_speed(7000, kSteps);
  for (int n = 0; n < 30; ++n) REQUIRE(dynamics.integrate(state, period));
  int parted = 0;
  for (int n = 0; n < 5; ++n) {
    energy = {};
    REQUIRE(dynamics.integrate(state, period, &energy));
    parted += static_cast<int>((period.mesh_force.array() == 0).count());
    CHECK(energy.imbalance < 1e-12 * energy.throughput);
    CHECK(std::abs(energy.dropped) < 1e-9 * energy.throughput);
    CHECK(energy.bearing_damping.head(4).minCoeff() > 0);
    CHECK(energy.bearing_damping[kRing] == 0);
    CHECK(energy.bearing_damping[kCarrier] > 0);
    CHECK(std::abs(energy.drive[kCarrier]) > 0);
  }
  CHECK(parted > 0);
}

TEST_CASE("a carrier that turns is in the period map, pushed and turned by what its planets do not cancel") {
  SystemDynamics& dynamics = turning().dynamics;
  SystemPeriodMap map(dynamics, kSteps);
  map.set_parameter(2600);
  const PeriodicMotion motion = iterate_to_orbit(map, map.rest(), {1e-10, 3000, true});
  REQUIRE(motion.multiple == 1);
  map.apply(motion.state);
  const SystemDynamics::Period period = map.period();
  // z_s / N is not whole: harmonic l turns central members only where z_s l / N is, and pushes them only where it is not.
  const Harmonics turns = harmonics(VectorXd(period.contact_torque.row(kCarrier)), 6),
                  pushes = harmonics(VectorXd(period.bearing_force[kCarrier].row(0)), 6);
  for (const int l : {1, 2, 4, 5}) CHECK(turns.amplitude[l - 1] < 1e-6 * turns.amplitude.maxCoeff());
  for (const int l : {3, 6}) CHECK(pushes.amplitude[l - 1] < 1e-6 * pushes.amplitude.maxCoeff());
  CHECK(turns.amplitude.maxCoeff() > 1e-2);
  CHECK(pushes.amplitude.maxCoeff() > 1);
  // Over a periodic motion what turns the carrier is its load, but for the force that holds the mean speed.
  CHECK(turns.mean == relative(-kOfCarrier, 1e-3));
  check_tangent(map, motion.state, 2 * dynamics.coordinates().size());
}

TEST_CASE("a heavy carrier on a stiff bearing is one that is held") {
  const auto errors = [](const SystemModel& system, double speed) {
    Moving rig(system);
    SystemDynamics::State state = rig.dynamics.rest();
    SystemDynamics::Period period;
    rig.dynamics.set_speed(speed, kSteps);
    for (int n = 0; n < 60; ++n) REQUIRE(rig.dynamics.integrate(state, period));
    return MatrixXd(period.transmission_error);
  };
  const Drives held = {{"sun", kTorque, kTrainTorque, 0}, {"ring", kHeld, 0, 0}, {"carrier", kHeld, 0, 0}};
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    const MatrixXd rigid = errors(train_with(held, 0, false, pins), 2600);
    const auto off = [&](double factor, double stiffness) {
      return (errors(train_with(kCarrierTurns, stiffness, false, pins, factor), 2600) - rigid).norm() /
             rigid.norm();
    };
    const double one = off(100, 0), two = off(200, 0);
    CHECK(one < 0.01);
    CHECK(two == relative(0.5 * one, 0.1));
    const double soft = off(1e7, 4e11), stiff = off(1e7, 8e11);
    CHECK(soft < 0.01);
    CHECK(stiff < 0.55 * soft);
  }
}

TEST_CASE("planets on rigid pins of a carrier that is lighter than they are: rejected with both numbers") {
  const SystemModel system = train_with(kCarrierTurns, 0, true, false, 1e-6);
  CHECK(names(message_of([&] { motion_of(system, 4e8); }), {"planets", "below"}));
}

namespace {

struct MomentumError {
  double turning = 0, moving = 0;  // of the impulse of the planets
};
// Own momentum of the carrier over a mesh period, without that of planets on rigid pins, against the impulse, by trapezia, of what
// acts on it: forces of its planets on their pins, its bearing, its load, damping by mass.
MomentumError momentum_error(bool elastic_pins, int steps) {
  constexpr double kMassDamping = 300, kSpeed = 2600;
  SystemModel system =
      train_with({{"sun", kHeld, 0, 0}, {"ring", kHeld, 0, 0}, {"carrier", kTorque, -kOfCarrier, 0}}, 2e8,
                 true, elastic_pins);
  System::Body& carrier = system.layout.bodies[kCarrier];
  carrier.bearing.damping = 0;
  for (size_t b = 1; b < kRing; ++b) system.layout.bodies[b].bearing.damping = 0;
  double own_mass = carrier.bearing.mass, own_inertia = carrier.inertia;
  if (!elastic_pins) {
    const double planets = 3 * system.body[1]->body().mass;
    carrier.bearing.mass += planets;
    carrier.inertia += planets * carrier.radius * carrier.radius;
  }
  SystemMotion motion = motion_of(system, 4e8, 0);
  motion.damping.rayleigh_mass = kMassDamping;
  motion.damping.bearing_ratio = 0;
  SystemDynamics dynamics(system, motion);
  dynamics.set_positions(std::vector<double>(6, 60e-6), steps);
  dynamics.set_speed(kSpeed, steps);
  SystemDynamics::State now = dynamics.rest();
  SystemDynamics::Period before, period;
  for (int n = 0; n < 2; ++n) REQUIRE(dynamics.integrate(now, before));
  const SystemDynamics::State old = now;
  REQUIRE(dynamics.integrate(now, period));
  double turned = 0, largest_turned = 0;
  Vec2 moved(0, 0);
  double largest_moved = 0;
  for (int i = 0; i <= steps; ++i) {  // sample 0 is that of the end
    const SystemDynamics::Period& of = i == 0 ? before : period;
    const double weight = (i % steps == 0 ? 0.5 : 1) / (steps * kSpeed);
    double moment = system.layout.torque(kCarrier);
    Vec2 force = -of.bearing_force[kCarrier].col(i % steps);
    for (size_t b = 1; b < kRing; ++b) {
      const Vec2 pin = of.bearing_force[b].col(i % steps);
      moment += carrier.radius * pin_direction(system.layout, system.layout.bodies[b]).dot(pin);
      force += pin;
    }
    turned += weight * moment;
    moved += weight * force;
    largest_turned += weight * std::abs(moment);
    largest_moved += weight * force.norm();
  }
  const SystemCoordinates& c = dynamics.coordinates();
  const double turns =
      c.rotation_of(kCarrier, now.v - old.v) + kMassDamping * c.rotation_of(kCarrier, now.z - old.z);
  const Vec2 moves =
      c.translation_of(kCarrier, now.v - old.v) + kMassDamping * c.translation_of(kCarrier, now.z - old.z);
  return {std::abs(turned - own_inertia * turns) / largest_turned,
          (moved - own_mass * moves).norm() / largest_moved};
}

}  // namespace

TEST_CASE(
    "forces on elastic and on rigid pins give a carrier its momentum, to second order of the time step") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    const MomentumError one = momentum_error(pins, 96), two = momentum_error(pins, 384);
    CHECK(two.turning < 1e-4);
    CHECK(two.moving < 1e-4);
    CHECK(two.turning < 0.1 * one.turning);
    CHECK(two.moving < 0.1 * one.moving);
  }
}

TEST_CASE(
    "stiff pins of a carrier that turns carry what rigid ones do, to the first order of their flexibility") {
  const auto forces = [](double stiffness) {
    SystemModel system = train_with(kCarrierTurns, 2e8, true, stiffness > 0);
    double planets = 0;
    for (size_t b = 1; b < kRing; ++b) {
      planets += system.body[b]->body().mass;
      system.layout.bodies[b].bearing.stiffness = stiffness;
    }
    System::Body& carrier = system.layout.bodies[kCarrier];
    if (!(stiffness > 0)) {
      carrier.bearing.mass += planets;
      carrier.inertia += planets * carrier.radius * carrier.radius;
    }
    SystemMotion motion = motion_of(system, 4e8, 1e-6);
    SystemDynamics dynamics(system, motion);
    dynamics.set_positions(std::vector<double>(6, 60e-6), 192);
    dynamics.set_speed(2600, 192);
    SystemDynamics::State state = dynamics.rest();
    SystemDynamics::Period period;
    for (int n = 0; n < 50; ++n) REQUIRE(dynamics.integrate(state, period));
    return period;
  };
  const SystemDynamics::Period rigid = forces(0);
  // Harmonics 1 to 3 on the pin of the first planet; its force is the mean of a step, so steps are short.
  const auto of_pin = [](const Eigen::Matrix2Xd& force) {
    return Eigen::Vector2d(harmonics(VectorXd(force.row(0)), 3).amplitude.norm(),
                           harmonics(VectorXd(force.row(1)), 3).amplitude.norm())
        .norm();
  };
  const auto off = [&](double stiffness) {
    return of_pin(forces(stiffness).bearing_force[1] - rigid.bearing_force[1]) /
           of_pin(rigid.bearing_force[1]);
  };
  const double one = off(16e9), two = off(32e9);
  CHECK(one < 0.1);
  CHECK(two == relative(0.5 * one, 0.1));
}

TEST_CASE(
    "what a sweep leaves out of a carrier that turns: forces at the highest speed, by which gear stands still") {
  const auto of = [](const Drives& drives) {
    SweepResult sweep;
    sweep.layout = train_with(drives, 0).layout;
    sweep.mesh_frequency = Eigen::Vector2d(3000, 1000);
    sweep.mesh_force.assign(2, MatrixRM::Constant(4, 6, 500));
    sweep.mesh_force[0].col(1).setConstant(2000);
    return turning_carriers(sweep);
  };
  const std::vector<TurningCarrier> turns = of(kCarrierTurns);
  REQUIRE(turns.size() == 1);
  const double speed = 2 * std::numbers::pi * 3000 / 100, mass = train_body(37, false).mass,
               radius = 0.5 * (26 + 37) * kTrainModule;
  CHECK(turns[0].turns);
  CHECK(turns[0].carrier == static_cast<int>(kCarrier));
  CHECK(turns[0].still == static_cast<int>(kRing));
  CHECK(turns[0].mesh_frequency == 3000);
  CHECK(turns[0].speed == relative(speed, 1e-12));
  CHECK(turns[0].centrifugal_force == relative(mass * radius * speed * speed, 1e-12));
  CHECK(turns[0].mesh_force == 2000);
  CHECK(turns[0].coriolis == relative(0.02, 1e-12));
  CHECK(turns[0].in_motion);
  // Held, as the frame; by the sun; none of its gears.
  const auto frame = of({{"sun", kTorque, kTrainTorque, 0}, {"ring", kHeld, 0, 0}, {"carrier", kHeld, 0, 0}});
  REQUIRE(frame.size() == 1);
  CHECK(!frame[0].turns);
  CHECK(!frame[0].in_motion);
  CHECK(frame[0].centrifugal_force == turns[0].centrifugal_force);
  CHECK(of({{"sun", kHeld, 0, 0}, {"ring", kTorque, -kOfRing, 0}, {"carrier", kTorque, -kOfCarrier, 0}})[0]
            .speed == relative(speed * 100 / 26, 1e-12));
  const auto none = of({{"sun", kTorque, kTrainTorque, 0},
                        {"ring", kTorque, -kOfRing, 0},
                        {"carrier", kTorque, -kOfCarrier, 0}});
  REQUIRE(none.size() == 1);
  CHECK(none[0].still == -1);
  CHECK(none[0].relative_force() == 0);
  CHECK(of({{"sun", kTorque, kTrainTorque, 0}, {"ring", kTorque, -kOfRing, 0}, {"carrier", kHeld, 0, 0}})
            .empty());
}

TEST_CASE(
    "the shipped train whose carrier turns is the one whose carrier is held, with the carrier of Lin and Parker") {
  const Scene held = read_scene("data/scenes/oh58-planetary.toml"),
              scene = read_scene("data/scenes/oh58-planetary-carrier.toml"),
              rigid = read_scene("data/scenes/lin-parker-planetary.toml");
  const System layout = layout_of(scene), other = layout_of(held);
  check_at_rest(scene, layout);
  REQUIRE(layout.bodies.size() == other.bodies.size());
  for (size_t b = 0; b + 1 < layout.bodies.size(); ++b) {
    CHECK(layout.bodies[b].angle == other.bodies[b].angle);
    CHECK(layout.bodies[b].bearing.stiffness == other.bodies[b].bearing.stiffness);
    CHECK(layout.bodies[b].bearing.damping == other.bodies[b].bearing.damping);
  }
  for (size_t m = 0; m < layout.meshes.size(); ++m) CHECK(layout.meshes[m].phase == other.meshes[m].phase);
  CHECK(layout.torque(0) == other.torque(0));
  CHECK(scene.damping.rayleigh_stiffness == held.damping.rayleigh_stiffness);
  const System::Body& carrier = layout.bodies.back();
  CHECK(moving_carrier(layout, static_cast<int>(layout.bodies.size()) - 1));
  const Bearing from = layout_of(rigid).bodies.back().bearing;
  CHECK(carrier.bearing.stiffness == from.stiffness);
  CHECK(carrier.bearing.mass == from.mass);
  CHECK(carrier.inertia == relative(rigid.carriers[0].equivalent_mass * std::pow(carrier.radius, 2), 1e-12));
}
