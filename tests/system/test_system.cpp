// Systems of several bodies and meshes: how they stand, what joins their meshes, and their equilibrium.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "gear/layout.h"
#include "gear/train.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "system/statics.h"
#include "system/system_statics.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi, kTorque = 60;

// Three gears of module 2 mm: 30, 60 and 120 teeth.
const std::array<int, 3> kTeeth{30, 60, 120};
const std::array<double, 3> kBore{14e-3, 30e-3, 80e-3};

GearDesign train_gear(size_t b) {
  GearDesign d = paper_gear(kTeeth[b], kBore[b]);
  d.module = 2e-3;
  d.face_width = 20e-3;
  return d;
}

const std::vector<ReducedBody>& train_bodies() {
  static const auto body = [](size_t b) { return kept_body(train_gear(b), paper_steel(), 1.5e-3, 1); };
  static const std::vector<ReducedBody> bodies{body(0), body(1), body(2)};
  return bodies;
}

constexpr std::array<double, 2> kDistance{0.090, 0.180};

// The three gears, the second mesh in the direction `turn` (rad) from the first one's.
System train(double turn = 0, const Bearing& idler = {}, double first = 0.3) {
  System system;
  add_input_gear(system, "a", train_gear(0));
  add_driven_gear(system, 0, train_gear(0), "b", train_gear(1), kDistance[0], first, idler);
  add_driven_gear(system, 1, train_gear(1), "c", train_gear(2), kDistance[1], first + turn);
  return system;
}

GearMeshSpec train_mesh(size_t m, bool corner = true) {
  GearMeshSpec mesh;
  mesh.gear = m == 0 ? std::array<std::string, 2>{"a", "b"} : std::array<std::string, 2>{"b", "c"};
  mesh.centre_distance = kDistance[m];
  mesh.corner.enabled = corner;
  return mesh;
}

// Torque on the first gear, gear `held` held.
SystemModel loaded_train(System system, int held, bool corner = true, double torque = kTorque) {
  system.drives = {{0, System::DriveKind::torque, torque}, {held, System::DriveKind::held, 0}};
  return {system, train_bodies(), {train_mesh(0, corner), train_mesh(1, corner)}};
}

SystemModel loaded_pair_of(size_t m, double torque, bool corner = true) {
  SystemModel system(train_bodies()[m], train_bodies()[m + 1], train_mesh(m, corner));
  system.layout.drives.push_back({0, System::DriveKind::torque, torque});
  return system;
}

Vec2 turned(double angle, const Vec2& v) {
  return Eigen::Rotation2Dd(angle) * v;
}

// Of body b at a phase, in the frame of the system: a point of a flank of one of its teeth.
Vec2 flank_point(const System& system, int b, FlankSide side, int tooth, double roll, double phase) {
  const System::Body& body = system.bodies[static_cast<size_t>(b)];
  Vec2 own = ToothGeometry(train_gear(static_cast<size_t>(b))).flank_point(roll);
  if (side == FlankSide::trailing) own.x() = -own.x();
  const double angle = body.angle + (body.sense * phase + tooth) * 2 * kPi / body.teeth;
  return Vec2(body.centre[0], body.centre[1]) + turned(angle, own);
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::vector<CandidateZone> ranges(const SystemModel& system) {
  return static_zones(system, 8, 1, 1);
}

SystemPosition position_at(const SystemModel& system, double phase, int period = 0) {
  std::vector<MeshPosition> meshes;
  const std::vector<CandidateZone> range = ranges(system);
  for (size_t m = 0; m < system.mesh.size(); ++m)
    meshes.push_back(make_position(system.mesh[m],
                                   mesh_instant(system, static_cast<int>(m), phase, period).phase, range[m]));
  return join(system, phase, period, std::move(meshes));
}

}  // namespace

TEST_CASE(
    "teeth of a train meet where the meshes say, whatever the angle: both flanks are at the same point") {
  for (const double turn : {0.0, 0.7, -2.0, kPi}) {
    CAPTURE(turn);
    const SystemModel system = loaded_train(train(turn), 2);
    const System& layout = system.layout;
    REQUIRE(layout.bodies.size() == 3);
    REQUIRE(layout.meshes.size() == 2);
    CHECK(layout.bodies[0].sense == 1);
    CHECK(layout.bodies[1].sense == -1);
    CHECK(layout.bodies[2].sense == 1);
    // The idler works with both of its flanks.
    CHECK(layout.meshes[0].side[1].flank == FlankSide::leading);
    CHECK(layout.meshes[1].side[0].flank == FlankSide::trailing);
    CHECK(layout.meshes[0].phase == 0);
    int seen = 0;
    for (const double phase : {0.0, 0.3, 0.85})
      for (const int period : {0, 1, 7}) {
        const SystemPosition position = position_at(system, phase, period);
        for (const ContactSegment& segment : position.segment) {
          const GearMeshModel& mesh = system.mesh[static_cast<size_t>(segment.mesh)];
          const PairContact contact = mesh.kinematics.contact(segment.phase);
          if (contact.corner) continue;
          ++seen;
          // The spring of rigid gears acts along the same line.
          CHECK((line_of_action(mesh.layout) - segment.normal).norm() < 1e-12);
          std::array<Vec2, 2> at;
          for (size_t s = 0; s < 2; ++s) {
            const int b = mesh.layout.side[s].body;
            const System::Body& body = layout.bodies[static_cast<size_t>(b)];
            at[s] = flank_point(layout, b, mesh.layout.side[s].flank, segment.tooth[s], contact.roll[s],
                                phase + period);
            const Vec2 arm = at[s] - Vec2(body.centre[0], body.centre[1]);
            // A force along the normal drives the second side and resists the first one.
            CHECK(body.sense * cross(arm, segment.normal) == relative(segment.lever[s], 1e-9));
          }
          CHECK((at[0] - at[1]).norm() < 1e-12);
        }
      }
    CHECK(seen > 20);
  }
}

TEST_CASE(
    "the compliance of a system is symmetric and positive definite; its meshes are joined by the idler") {
  for (const double turn : {0.0, 1.1}) {
    Bearing soft;
    soft.stiffness = 2e8;
    for (const Bearing& idler : {Bearing(), soft}) {
      const SystemModel system = loaded_train(train(turn, idler), 2);
      const SystemPosition position = position_at(system, 0.4);
      const std::array depth{1e-3, 1e-3};
      const Eigen::MatrixXd a = contact_compliance(system, position, compliance_tables(system, depth), depth);
      CHECK((a - a.transpose()).norm() < 1e-12 * a.norm());
      CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues()[0] > 0);
      // Forces of both meshes twist the idler's ring against its hub in opposite senses: one eases the other.
      const Eigen::MatrixXd joint = a(position.strips_of(0), position.strips_of(1));
      const double own = a(position.strips_of(0), position.strips_of(0)).mean();
      if (!idler.elastic()) {
        CHECK(joint.maxCoeff() < 0);
        CHECK(joint.mean() < -0.005 * own);
      }
      // With friction they will differ.
      CHECK(position.load.rotation == position.displacement.rotation);
    }
  }
}

// Gear b of the train drives the other one of its first mesh, from there in a direction.
SystemModel first_mesh(size_t driver, double torque, double direction, bool corner = true) {
  const size_t driven = 1 - driver;
  System layout;
  add_input_gear(layout, "a", train_gear(driver));
  add_driven_gear(layout, 0, train_gear(driver), "b", train_gear(driven), kDistance[0], direction);
  layout.drives = {{0, System::DriveKind::torque, torque}, {1, System::DriveKind::held, 0}};
  return {layout, {train_bodies()[driver], train_bodies()[driven]}, {train_mesh(0, corner)}};
}

TEST_CASE("a pair is a system of two bodies: the same numbers in any direction") {
  const StaticResult statics = [] {
    StaticParameters settings;
    settings.mesh = train_mesh(0);
    settings.contact.positions = 8;
    return static_transmission(train_bodies()[0], train_bodies()[1], settings, kTorque);
  }();
  for (const double direction : {-0.9, 2.2}) {
    const SystemModel system = first_mesh(0, kTorque, direction);
    const std::vector<SystemSolution> solutions = rest_over_period(system, ContactModel::strips, 8, 8);
    for (int i = 0; i < 8; ++i) {
      const SystemSolution& at = solutions[static_cast<size_t>(i)];
      CHECK(at.transmission_error[0] == relative(statics.transmission_error[i], 1e-12));
      for (const LoadedSegment& load : at.loads)
        for (Eigen::Index j = 0; j < statics.pair.size(); ++j)
          if (statics.pair[j] == load.pair)
            CHECK(std::abs(load.force - statics.tooth_load(i, j)) < 1e-10 * statics.tooth_load.maxCoeff());
    }
  }
}

// Teeth are symmetric, so the pair in which the other gear drives is the mirror image that runs backwards: what it does at phase f
// this one does at -f, the pair of teeth -n in place of n. Lines keep to it to rounding, strips to what 8 of them resolve.
TEST_CASE("a pair whose gears change roles has its transmission error and loads at the opposite phases") {
  constexpr int kPositions = 8;
  const SystemModel one = first_mesh(0, kTorque, 2.2, false),
                    other = first_mesh(1, kTorque * one.base_radius(1) / one.base_radius(0), -0.4, false);
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    CAPTURE(contact);
    const double within = contact == ContactModel::line ? 1e-9 : 1e-3;
    const std::vector<SystemSolution> there = rest_over_period(one, contact, 8, kPositions),
                                      back = rest_over_period(other, contact, 8, kPositions);
    double largest = 0;
    for (int i = 0; i < kPositions; ++i) {
      const SystemSolution &a = there[static_cast<size_t>(i)],
                           &b = back[static_cast<size_t>((kPositions - i) % kPositions)];
      CHECK(a.transmission_error[0] == relative(b.transmission_error[0], within));
      // Phase 0 is its own opposite, others are the opposite in the period before.
      for (const LoadedSegment& load : a.loads)
        for (const LoadedSegment& mirrored : b.loads)
          if (mirrored.pair == (i == 0 ? 0 : -1) - load.pair)
            CHECK(std::abs(load.force - mirrored.force) < within * kTorque / one.base_radius(0));
      largest = std::max(largest, std::abs(a.transmission_error[0] - there[0].transmission_error[0]));
    }
    CHECK(largest > 1e-7);  // m: it does depend on the phase
  }
}

TEST_CASE("a third gear without torque: the first two are the pair, the second mesh carries nothing") {
  const SystemModel system = loaded_train(train(), 1), pair = loaded_pair_of(0, kTorque);
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    const std::vector<SystemSolution> three = rest_over_period(system, contact, 8, 6),
                                      two = rest_over_period(pair, contact, 8, 6);
    for (size_t i = 0; i < 6; ++i) {
      CHECK(three[i].transmission_error[0] == relative(two[i].transmission_error[0], 1e-12));
      for (const LoadedSegment& load : three[i].loads)
        if (load.mesh == 1) CHECK(load.force < 1e-11 * kTorque / system.base_radius(0));  // touches
    }
  }
  // The last gear free, and nothing held: no torque stays in the train.
  System loose = train();
  loose.drives = {{0, System::DriveKind::torque, kTorque}};
  CHECK_THROWS_AS(mesh_loads({loose, train_bodies(), {train_mesh(0), train_mesh(1)}}), Error);
  loose.drives = {};
  for (const int b : {0, 1, 2}) loose.drives.push_back({b, System::DriveKind::held});
  CHECK(names(message_of([&] {
                mesh_loads({loose, train_bodies(), {train_mesh(0), train_mesh(1)}});
              }),
              {"every", "body"}));
  CHECK(names(message_of([&] { mesh_loads(loaded_train(train(), 2, true, 0)); }), {"system", "drive"}));
  // Torque against the flow of power opens the meshes.
  CHECK_THROWS_AS(mesh_loads(loaded_train(train(), 2, true, -kTorque)), Error);
}

TEST_CASE(
    "three gears in line: torques of all bodies balance at every phase, each mesh has its transmission error") {
  const SystemModel system = loaded_train(train(), 2);
  const double force = kTorque / system.base_radius(0);
  const Eigen::VectorXd loads = mesh_loads(system);
  CHECK(loads[0] == relative(force, 1e-14));
  CHECK(loads[1] == relative(force, 1e-14));
  constexpr int kPositions = 12;
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    CAPTURE(contact);
    const std::vector<SystemSolution> solutions = rest_over_period(system, contact, 8, kPositions);
    std::array<double, 2> mean{};
    for (int i = 0; i < kPositions; ++i) {
      CAPTURE(i);
      const SystemSolution& at = solutions[static_cast<size_t>(i)];
      CHECK(at.equilibrium.residual < 1e-10);
      CHECK(at.equilibrium.p.minCoeff() >= 0);
      // Each body's torque from the forces of the segments and their arms, by hand.
      std::array<double, 3> torque{};
      for (const LoadedSegment& load : at.loads) {
        const GearMeshModel& mesh = system.mesh[static_cast<size_t>(load.mesh)];
        const PairContact contact_of = mesh.kinematics.contact(
            mesh_instant(system, load.mesh, static_cast<double>(i) / kPositions, 0).phase + load.pair);
        for (size_t s = 0; s < 2; ++s)
          torque[static_cast<size_t>(mesh.layout.side[s].body)] +=
              (s == 0 ? -1 : 1) * contact_of.lever[s] * load.force;
      }
      CHECK(torque[0] == relative(-kTorque, 1e-10));
      CHECK(std::abs(torque[1]) < 1e-10 * kTorque);
      CHECK(torque[2] > 0);
      CHECK(at.equilibrium.x[2] == 0);
      for (size_t m = 0; m < 2; ++m) {
        CHECK(at.transmission_error[m] > 0);
        mean[m] += at.transmission_error[m] / kPositions;
      }
      CHECK(at.transmission_error[0] + at.transmission_error[1] == relative(at.equilibrium.x[0], 1e-14));
    }
    // Each mesh gives way less than as a pair: the idler's ring is pushed by one mesh and held by the other, it twists on its
    // hub in neither.
    for (size_t m = 0; m < 2; ++m) {
      const SystemModel pair = loaded_pair_of(m, force * system.base_radius(static_cast<int>(m)));
      double alone = 0;
      for (const SystemSolution& at : rest_over_period(pair, contact, 8, kPositions))
        alone += at.transmission_error[0] / kPositions;
      CHECK(mean[m] < alone);
      CHECK(mean[m] > 0.7 * alone);
    }
  }
}

TEST_CASE(
    "meshes that nothing joins are pairs, each at its own phase: the multi-freedom search against the scalar one") {
  const SystemModel system = loaded_train(train(0.9), 2, false);
  const std::array depth{1e-3, 1e-3};
  const SystemTables tables = compliance_tables(system, depth);
  for (const double phase : {0.0, 0.37, 0.81}) {
    const SystemPosition position = position_at(system, phase);
    Eigen::MatrixXd a = contact_compliance(system, position, tables, depth);
    a(position.strips_of(0), position.strips_of(1)).setZero();
    a(position.strips_of(1), position.strips_of(0)).setZero();
    ComplementaritySolver solver;
    const SystemEquilibrium whole = equilibrium(system, position, a, Eigen::VectorXd::Zero(3), solver);
    for (int m = 0; m < 2; ++m) {
      const SystemModel pair =
          loaded_pair_of(static_cast<size_t>(m), mesh_loads(system)[m] * system.base_radius(m), false);
      SystemStatics statics(pair, ContactModel::strips, {ranges(system)[static_cast<size_t>(m)]});
      const SystemSolution& alone =
          statics.solve(mesh_instant(system, m, phase, 0).phase, 0, Eigen::VectorXd::Zero(2));
      CHECK(whole.transmission_error(system, m) == relative(alone.transmission_error[0], 1e-9));
    }
  }
}

TEST_CASE(
    "an idler in line loads its bearing with twice the tangential force, and moves by that over its stiffness") {
  Bearing idler;
  idler.stiffness = 3e8;
  const SystemModel system = loaded_train(train(0, idler), 2, false), rigid = loaded_train(train(), 2, false);
  const double force = kTorque / system.base_radius(0), pressure = 20 * kPi / 180;
  const std::vector<SystemSolution> soft = rest_over_period(system, ContactModel::strips, 8, 4),
                                    hard = rest_over_period(rigid, ContactModel::strips, 8, 4);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(soft[i].bearing_force[1].norm() == relative(2 * force * std::cos(pressure), 1e-9));
    CHECK(soft[i].bearing_force[0].norm() == relative(force, 1e-9));  // a rigid axis
    // The idler gives way across the line of centres: each mesh closes by its share along the line of action.
    const double way = 2 * force * std::cos(pressure) * std::cos(pressure) / idler.stiffness;
    for (size_t m = 0; m < 2; ++m) {
      CHECK(soft[i].transmission_error[m] - soft[i].deflection[m] == relative(way, 1e-8));
      CHECK(soft[i].deflection[m] == relative(hard[i].deflection[m], 1e-9));
    }
  }
}
