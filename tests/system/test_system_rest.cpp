// Systems of elastic gears at rest: balance of every body, what equal planets do to each other, frozen stiffness and modes.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "gear/system_layout.h"
#include "io/scene.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "signal/spectrum.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/natural_modes.h"
#include "system/rest_record.h"
#include "system/system_rest.h"
#include "system/system_statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi, kTorque = 300, kModule = 2.776e-3;
constexpr int kPositions = 12;

GearDesign elastic_gear(int teeth, bool internal) {
  GearDesign design = rigid_gear(teeth, internal);
  if (!internal) design.bore_radius = (0.5 * teeth - 5) * kModule;
  return design;
}

// Coarse bodies, each reduced once.
const ReducedBody& body_of(int teeth, bool internal) {
  return kept_body(elastic_gear(teeth, internal), Material{206e9, 0.3, 7850, true}, 2.5e-3, 1);
}

// Sun, three planets and ring; the sun floats, planets stand on elastic pins; ring and carrier are held.
Scene train(const std::array<int, 3>& teeth, ContactModel contact, bool corner) {
  Scene scene = planetary_train(3);
  scene.fidelity = {BodyModel::modal, contact, Integrator::exact};
  scene.contact = {4, kPositions};
  const std::array stiffness{2e7, 3e8, 0.0};
  for (size_t g = 0; g < 3; ++g) {
    SceneGear& gear = scene.gears[g];
    gear.design = elastic_gear(teeth[g], g == 2);
    gear.material = {206e9, 0.3, 7850, true};
    gear.equivalent_mass = 0;
    gear.bearing = {stiffness[g], 0, 0};
  }
  scene.carriers[0].bearing = {};
  for (Scene::Mesh& mesh : scene.meshes) {
    mesh.spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * kModule;
    mesh.spec.corner.enabled = corner;
  }
  scene.drives = {{"sun", System::DriveKind::torque, kTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  return scene;
}

SystemStaticResult at_rest(const Scene& scene) {
  std::vector<ReducedBody> bodies;
  for (const SceneGear& gear : scene.gears)
    bodies.push_back(body_of(gear.design.teeth, gear.design.internal));
  return system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies);
}

// What tip edges change of moments and forces: their normals are tilted against the line of action.
constexpr double kTipEdges = 0.01;

// Bodies of a train of three planets: 0 the sun, 1 to 3 the planets, 4 the ring, 5 the carrier.
constexpr Index kRing = 4, kCarrier = 5;

double torque_left(const SystemStaticResult& a, Index phase) {
  double sum = 0;
  for (const Index b : {Index{0}, kRing, kCarrier})
    sum += a.settings.layout.bodies[static_cast<size_t>(b)].sense * a.torque(phase, b);
  return std::abs(sum);
}

}  // namespace

TEST_CASE(
    "planetary train at rest: every body balances at every phase, pins carry the carrier, loads add up") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const SystemStaticResult a = at_rest(train({26, 37, 100}, contact, true));
    const double force = kTorque / ToothGeometry(elastic_gear(26, false)).base_radius();
    REQUIRE(a.mesh_phase.size() == kPositions);
    for (Index i = 0; i < kPositions; ++i) {
      CHECK(torque_left(a, i) < 1e-8 * kTorque);
      // Normal forces on the teeth, which act at the base radius but for tip edges: the sun's moment is the drive's torque, what
      // comes to a planet goes on to the ring, and shares are those of the forces.
      VectorXd load(6);
      for (Index m = 0; m < 6; ++m) load[m] = a.mesh[static_cast<size_t>(m)].tooth_load.row(i).sum();
      CHECK((a.mesh_force.row(i).transpose() - load).norm() < 1e-12 * force);
      CHECK(load.head(3).sum() * kTorque / force == relative(a.torque(i, 0), kTipEdges));
      for (Index n = 0; n < 3; ++n) {
        CHECK(load[n] == relative(load[3 + n], kTipEdges));
        CHECK(a.load_share(i, n) == relative(load[n] / load.head(3).sum(), 1e-12));
      }
      // Contact forces of all gears come in pairs, so that bearings, pins and what holds the ring carry nothing together.
      const MatrixRM& bearing = a.bearing_force[static_cast<size_t>(i)];
      CHECK(bearing.topRows(5).colwise().sum().norm() < 1e-9 * force);
      // Along the lines of action of both meshes of each planet.
      Vec2 pins(0, 0);
      for (Index m = 0; m < 6; ++m)
        pins += closing_sign(m < 3 ? 1 : 0) * -load[m] *
                line_of_action(a.settings.layout.meshes[static_cast<size_t>(m)]);
      CHECK((Vec2(bearing.row(kCarrier)) - pins).norm() < kTipEdges * force);
      // Willis: of torques z_s and z_r, but for what tip edges change.
      CHECK(a.torque(i, kRing) == relative(-kTorque * 100 / 26, kTipEdges));
      CHECK(load.sum() > 2 * force * 0.99);
      CHECK(a.rotation(i, 0) > 0);
    }
    CHECK(a.least_force >= 0);
    CHECK(a.least_gap > -1e-13);
    CHECK(a.torque_residual < 1e-10);
  }
}

TEST_CASE("a zone of contact that was too narrow leaves nothing in the balance of the position") {
  const Scene scene = train({26, 37, 100}, ContactModel::strips, true);
  std::vector<ReducedBody> bodies;
  bodies.reserve(scene.gears.size());
  for (const SceneGear& gear : scene.gears)
    bodies.push_back(body_of(gear.design.teeth, gear.design.internal));
  SystemStaticResult a = system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies);
  const SystemModel system = elastic_system(a.settings, bodies);
  std::vector<GearPairParameters> of;
  of.reserve(system.mesh.size());
  for (size_t m = 0; m < system.mesh.size(); ++m) of.push_back(mesh_parameters(a, m));
  // The zone grows by 1.6 times the load: of some factor within that a later position is the first to find it too narrow.
  bool again = false;
  for (double factor = 1; !again && factor > 0.79; factor -= 0.01) {
    int taken = 0;
    over_period(system, ContactModel::strips, of[0].contact.strips, kPositions, factor,
                [&](const RestStep&, const SystemSolution&, const SystemStatics&) { ++taken; });
    again = taken > kPositions;
    if (!again) continue;
    a.torque = record_rest(system, a.settings.section, of, factor, true).torque;
    for (Index i = 0; i < kPositions; ++i) CHECK(torque_left(a, i) < 1e-8 * kTorque);
  }
  CHECK(again);
}

TEST_CASE(
    "each mesh of a train has the root stress of its own loads: alike planets alike, a period later the next") {
  const SystemStaticResult a = at_rest(train({26, 37, 100}, ContactModel::line, true));
  const Index third = kPositions / 3;
  for (const size_t first : {0, 3})
    for (size_t g = 0; g < kSides; ++g) {
      const MatrixRM& stress = a.mesh[first].root_stress[g];
      REQUIRE(stress.rows() == kPositions);
      // The tooth that carries most is stressed most, and one without load at most as its loaded neighbours make it.
      CHECK(a.mesh[first].root_stress_max[static_cast<Index>(g)] >= stress.maxCoeff());
      CHECK(stress.maxCoeff() > 0);
      // Sequential phases: what the second planet does, the first one or the third does a third of a period later.
      const MatrixRM& other = a.mesh[first + 1].root_stress[g];
      double after = 0, before = 0;
      for (Index i = 0; i < kPositions; ++i) {
        const double now = stress.row(i).maxCoeff();
        after = std::max(after, std::abs(other.row((i + third) % kPositions).maxCoeff() - now));
        before = std::max(before, std::abs(other.row((i + 2 * third) % kPositions).maxCoeff() - now));
      }
      CHECK(std::min(after, before) < 1e-6 * stress.maxCoeff());
    }
}

TEST_CASE(
    "equal planets with equal mesh phases: each carries a third at every phase, central bearings nothing") {
  const SystemStaticResult a = at_rest(train({27, 36, 99}, ContactModel::line, true));
  const double force = kTorque / ToothGeometry(elastic_gear(27, false)).base_radius();
  for (Index i = 0; i < kPositions; ++i) {
    for (Index m = 0; m < 6; ++m) CHECK(a.load_share(i, m) == relative(1.0 / 3, 1e-9));
    for (const Index b : {Index{0}, kRing, kCarrier})
      CHECK(a.bearing_force[static_cast<size_t>(i)].row(b).norm() < 1e-8 * force);
  }
  // The sun is turned by the first harmonic.
  CHECK(harmonics(VectorXd(a.rotation.col(0)), 1).amplitude[0] > 1e-9);
}

TEST_CASE(
    "sequential mesh phases: harmonic l turns the sun only where z_s l / N is whole, and pushes it only where it is not") {
  // z_s = 26, N = 3: a third of a mesh period later each planet does what the one before did, turned by a third.
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const SystemStaticResult a = at_rest(train({26, 37, 100}, contact, true));
    const int third = kPositions / 3;
    double most = 0, turned = 0;
    const double scale = a.rotation.col(0).mean();
    for (Index i = 0; i < kPositions; ++i) {
      CHECK(a.rotation((i + third) % kPositions, 0) == relative(a.rotation(i, 0), 1e-8));
      const Vec2 now = a.bearing_force[static_cast<size_t>(i)].row(0),
                 later = a.bearing_force[static_cast<size_t>((i + third) % kPositions)].row(0);
      most = std::max(most, now.norm());
      const double one = (later - Vec2(Eigen::Rotation2Dd(2 * kPi / 3) * now)).norm(),
                   other = (later - Vec2(Eigen::Rotation2Dd(-2 * kPi / 3) * now)).norm();
      turned = std::max(turned, std::min(one, other));
    }
    CHECK(most > 1);  // N
    CHECK(turned < 1e-6 * most + 1e-7);
    const VectorXd turn = harmonics(VectorXd(a.rotation.col(0)), 5).amplitude;
    for (const int l : {1, 2, 4, 5}) CHECK(turn[l - 1] < 1e-8 * scale);
    CHECK(turn[2] > 1e-5 * scale);
    VectorXd x(kPositions);
    for (Index i = 0; i < kPositions; ++i) x[i] = a.bearing_force[static_cast<size_t>(i)](0, 0);
    const Harmonics push = harmonics(x, 5);
    CHECK(std::abs(push.mean) < 1e-6 * most + 1e-7);
    CHECK(push.amplitude[2] < 1e-6 * most + 1e-7);
    CHECK(push.amplitude[0] > 0.1 * most);
  }
}

TEST_CASE(
    "frozen stiffness: the assembly of the modes, translations condensed, is the tangent of the statics") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const Scene scene = train({26, 37, 100}, contact, false);
    const SystemStaticResult a = at_rest(scene);
    const System& layout = a.settings.layout;
    std::vector<ReducedBody> bodies;
    std::vector<GearMeshSpec> specs;
    for (const System::Body& body : layout.bodies)
      if (body.kind == System::BodyKind::gear) bodies.push_back(body_of(body.teeth, body.teeth == 100));
    for (const int section : a.settings.section)
      specs.push_back(scene.meshes[static_cast<size_t>(section)].spec);
    const SystemModel system(layout, bodies, specs);
    for (const SystemSolution& at : rest_over_period(system, contact, 4, 3)) {
      CHECK((at.mesh_stiffness - at.mesh_stiffness.transpose()).norm() == 0);
      const RigidSystem rigid = rigid_system(layout, at.mesh_stiffness);
      // Rotations of sun and planets first, then what stands on springs.
      std::vector<Index> turns, moves;
      for (Index q = 0; q < rigid.freedoms(); ++q) {
        bool turn = false;
        for (const MatrixXd& u : rigid.rotation) turn = turn || u(0, q) != 0;
        (turn ? turns : moves).push_back(q);
      }
      REQUIRE(turns.size() == 4);
      REQUIRE(moves.size() == 8);
      const MatrixXd& k = rigid.stiffness;
      const MatrixXd condensed =
          k(turns, turns) - k(turns, moves) * k(moves, moves).ldlt().solve(k(moves, turns));
      CHECK((condensed - at.equilibrium.stiffness).norm() < 1e-8 * condensed.norm());
    }
  }
}

TEST_CASE("modes of an elastic train have the structure of the rigid one and the mean trace of its phases") {
  const SystemStaticResult a = at_rest(train({27, 36, 99}, ContactModel::line, false));
  for (const System::Body& body : a.settings.layout.bodies)
    if (body.kind == System::BodyKind::gear) CHECK(body.inertia > 0);
  const ModesResult modes = elastic_modes(a);
  REQUIRE(modes.natural_frequency.size() == 12);
  CHECK(modes.natural_frequency.minCoeff() > 0);
  // Planets are alike and phases equal: rotational modes single, translational ones double.
  int rotational = 0, translational = 0;
  for (size_t i = 0; i < modes.type.size(); ++i) {
    rotational += modes.type[i] == ModeType::rotational;
    translational += modes.type[i] == ModeType::translational;
  }
  CHECK(rotational == 4);
  CHECK(translational == 8);
  for (Index i = 0; i < 12; ++i)
    CHECK(modes.mesh_energy.row(i).sum() + modes.bearing_energy.row(i).sum() == relative(1, 1e-9));
  // The sum of w^2 is the trace of M^-1 K, linear in K. Of a symmetric matrix the least eigenvalue is concave and the largest
  // convex; those between need not lie among those of the phases.
  const double phases = static_cast<double>(modes.frozen_frequency.rows());
  CHECK(modes.natural_frequency.squaredNorm() ==
        relative(modes.frozen_frequency.squaredNorm() / phases, 1e-9));
  CHECK(modes.natural_frequency[0] >= modes.frozen_frequency.col(0).minCoeff() * (1 - 1e-9));
  CHECK(modes.natural_frequency[11] <= modes.frozen_frequency.col(11).maxCoeff() * (1 + 1e-9));
  const VectorXd trace = modes.frozen_frequency.rowwise().squaredNorm();
  CHECK(trace.maxCoeff() > 1.001 * trace.minCoeff());  // the phases do differ
}

TEST_CASE("a third gear without torque: no stiffness in its mesh, one more free motion, modes of the pair") {
  Scene scene = train({26, 37, 100}, ContactModel::line, false);
  scene.carriers.clear();
  scene.gears[2] = scene.gears[0];
  scene.gears[2].name = "last";
  scene.meshes[1].spec.gear[1] = "last";
  for (SceneGear& gear : scene.gears) gear.bearing = {};
  scene.drives = {{"sun", System::DriveKind::torque, kTorque, 0}, {"planet", System::DriveKind::held, 0, 0}};
  const SystemStaticResult a = at_rest(scene);
  for (const MatrixRM& k : a.mesh_stiffness) {
    CHECK(k(0, 0) > 1e8);
    CHECK(k(1, 1) == 0);
    CHECK(k(0, 1) == 0);
  }
  const ModesResult modes = elastic_modes(a);
  REQUIRE(modes.natural_frequency.size() == 2);
  CHECK(modes.natural_frequency[0] == 0);
  double mean = 0;
  for (const MatrixRM& k : a.mesh_stiffness) mean += k(0, 0) / static_cast<double>(a.mesh_stiffness.size());
  const System::Body& sun = a.settings.layout.bodies[0];
  CHECK(2 * kPi * modes.natural_frequency[1] == relative(std::sqrt(mean / sun.inertia) * sun.radius, 1e-12));
  // Springs of a scene are another matter: each needs its stiffness.
  System springs = a.settings.layout;
  springs.meshes[0].stiffness = 0;
  CHECK(names(message_of([&] { natural_modes(springs); }), {"sun-planet"}));
}

TEST_CASE("the four-planet set that ships and its rigid twin stand, turn and mesh alike") {
  const char *const elastic = "data/scenes/oh58-planetary.toml", *const rigid =
                                                                     "data/scenes/oh58-planetary-rigid.toml";
  const System a = layout_in(read_scene(elastic), elastic), b = layout_in(read_scene(rigid), rigid);
  REQUIRE(a.bodies.size() == b.bodies.size());
  for (size_t i = 0; i < a.bodies.size(); ++i) {
    CHECK(a.bodies[i].name == b.bodies[i].name);
    CHECK(a.bodies[i].radius == b.bodies[i].radius);
    CHECK(a.bodies[i].centre == b.bodies[i].centre);
    CHECK(a.bodies[i].bearing.stiffness == b.bodies[i].bearing.stiffness);
  }
  for (size_t m = 0; m < a.meshes.size(); ++m) CHECK(a.meshes[m].phase == b.meshes[m].phase);
  // 24.6 and 20.19 degrees, as published.
  CHECK(a.meshes[0].pressure_angle * 180 / kPi == relative(24.6, 1e-3));
  CHECK(a.meshes[4].pressure_angle * 180 / kPi == relative(20.19, 1e-3));
  // The elastic set has 1601.7 to 10009.9 Hz (make modes); the twin lacks what the sun's body joins.
  const ModesResult modes = natural_modes(b);
  CHECK(modes.natural_frequency[0] == relative(1601.74, 1e-3));
  CHECK(modes.natural_frequency[14] == relative(10009.9, 0.03));
}

TEST_CASE("a sun floats on any soft bearing: loads of no bearing to the first order, nothing jumps") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    const auto on = [&](double stiffness) {
      Scene scene = train({26, 37, 100}, contact, true);
      scene.contact.positions = 4;
      scene.gears[0].bearing.stiffness = stiffness;
      return at_rest(scene);
    };
    const SystemStaticResult free = on(10);
    const double load = free.mesh_force.maxCoeff();
    double before = 0;
    for (const double stiffness : {1e3, 1e4, 1e5}) {
      const double change = (on(stiffness).mesh_force - free.mesh_force).cwiseAbs().maxCoeff();
      if (before > 0) CHECK(change == relative(10 * before, 0.05));
      before = change;
    }
    CHECK(before < 1e-3 * load);
    // Softer than about 1 N per micrometre the hub's translations are freedoms of the equilibrium, else a part of the compliance.
    const MatrixRM soft = on(0.98e6).mesh_force, hard = on(1.04e6).mesh_force, harder = on(1.1e6).mesh_force;
    CHECK((soft - 2 * hard + harder).cwiseAbs().maxCoeff() < 1e-5 * load);
    // What the free sun's meshes push it with adds up to nothing.
    CHECK(free.bearing_force[0].row(0).norm() < 1e-6 * load);
  }
}

TEST_CASE(
    "stage parameters of elastic systems: read as written; what a scene of elastic gears cannot have is rejected") {
  const char* const kTrain = "data/scenes/oh58-planetary.toml";
  const Scene scene = read_scene(kTrain);
  CHECK(!scene.rigid());
  const SystemStaticParameters p = static_parameters_of(scene, layout_in(scene, kTrain));
  CHECK(p.gears() == std::vector<std::string>{"sun", "planet", "ring"});
  CHECK(p.gear == std::vector<std::string>{"sun", "planet", "planet", "planet", "planet", "ring", ""});
  CHECK(p.section == std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1});
  const std::string text = system_static_parameters(p);
  const SceneFile file;
  CHECK(system_static_parameters(read_system_static_parameters(file.path(text))) == text);
  const auto said = [&](const std::string& more) {
    std::ifstream in(kTrain);
    std::ostringstream whole;
    whole << in.rdbuf() << more;
    const std::string path = file.path(whole.str());
    return message_of([&] { read_scene(path); });
  };
  CHECK(said("").empty());
  CHECK(said("[gear.sun.modification]\ncrowning_um = 5\n").empty());
  CHECK(said("[gear.sun.error]\niso_class = 5\n[gear.planet.error]\niso_class = 5\n").empty());
  CHECK(names(
      said(
          "[gear.sun.error]\niso_class = 5\n[gear.ring.error]\niso_class = 5\n[gear.planet.error]\niso_class = 5\n"),
      {10395, "periods"}));
  CHECK(said("[gear.sun.crack]\ntooth = 1\ndepth_mm = 0.5\n").empty());
  CHECK(names(said("[[bearing]]\ngear = \"carrier\"\nstiffness_N_um = 5.0\n"), {"mass_kg"}));
  CHECK(said("[[bearing]]\ngear = \"carrier\"\nstiffness_N_um = 5.0\nmass_kg = 6.0\n").empty());
  CHECK(said("[fidelity]\ncontact = \"line\"\n").empty());
  // Motion: what the statics do not depend on is in parameters of its own.
  const SystemSweepParameters motion = sweep_parameters_of(scene, layout_in(scene, kTrain));
  CHECK(motion.frequency_to == 6000);
  const std::string moving = system_sweep_parameters(motion);
  CHECK(system_sweep_parameters(read_system_sweep_parameters(file.path(moving))) == moving);
  CHECK_THROWS_AS(read_system_static_parameters(file.path(moving)), Error);
  CHECK_THROWS_AS(read_system_sweep_parameters(file.path(text)), Error);
  const auto reads = [&](const char* start, const std::string& more) {
    std::ifstream in(start);
    std::ostringstream whole;
    whole << in.rdbuf();
    std::string scene_text = whole.str();
    scene_text.insert(!contains(scene_text, "\nmesh_frequency_Hz")
                          ? scene_text.size()
                          : scene_text.find("\nmesh_frequency_Hz") + 1,
                      more);
    return message_of([&] { read_scene(file.path(scene_text)); });
  };
  CHECK(names(reads(kTrain, "torque_Nm = 5.0\n"), {"[[drive]]"}));
  CHECK(names(reads("data/scenes/lin-parker-planetary.toml", "[damping]\n"), {"belongs", "elastic"}));
}

namespace {

// Coarse bodies of a scene's gears, and what of its statics does not need many positions.
SystemStaticResult coarsely_at_rest(Scene scene, ContactModel contact) {
  scene.fidelity.contact = contact;
  scene.contact = {4, kPositions};
  scene.body.element_size = 2.5e-3;
  scene.body.modes = 1;
  std::vector<ReducedBody> bodies;
  for (const SceneGear& gear : scene.gears)
    bodies.push_back(kept_body(gear.design, gear.material, scene.body));
  return system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies);
}

}  // namespace

TEST_CASE("the rigid twin of the four-planet set has its phases, stiffnesses, inertias and masses") {
  const Scene scene = read_scene("data/scenes/oh58-planetary.toml"),
              rigid = read_scene("data/scenes/oh58-planetary-rigid.toml");
  const SystemStaticResult a = coarsely_at_rest(scene, ContactModel::line);
  const System &elastic = a.settings.layout, twin = layout_of(rigid);
  REQUIRE(elastic.bodies.size() == twin.bodies.size());
  REQUIRE(elastic.meshes.size() == twin.meshes.size());
  for (size_t b = 0; b < twin.bodies.size(); ++b) {
    CAPTURE(b);
    CHECK(elastic.bodies[b].name == twin.bodies[b].name);
    if (twin.bodies[b].kind == System::BodyKind::carrier) continue;
    CHECK(twin.bodies[b].inertia == relative(elastic.bodies[b].inertia, 1e-3));
    CHECK(twin.bodies[b].bearing.stiffness == elastic.bodies[b].bearing.stiffness);
    if (twin.bodies[b].bearing.elastic())
      CHECK(twin.bodies[b].bearing.mass == relative(elastic.bodies[b].bearing.mass, 1e-3));
  }
  // From planet to planet; backlash, which the twin has none of, puts ring meshes ahead of the sun's.
  const auto ahead = [](const System& layout, size_t m) {
    return layout.meshes[m].phase - layout.meshes[m - m % 4].phase;
  };
  for (size_t m = 0; m < twin.meshes.size(); ++m)
    CHECK(std::abs(std::remainder(ahead(twin, m) - ahead(elastic, m), 1)) < 1e-9);
  // Planets opposite each other.
  for (const size_t n : {1, 2})
    for (const size_t axis : {0, 1})
      CHECK(std::abs(twin.bodies[n].centre[axis] + twin.bodies[n + 2].centre[axis]) < 1e-12);
  for (const Index first : {0, 4}) {
    double mean = 0;
    for (const MatrixRM& k : a.mesh_stiffness)
      mean += k.diagonal().segment(first, 4).mean() / static_cast<double>(a.mesh_stiffness.size());
    // The scene has finer elements and more positions.
    CHECK(rigid.meshes[first == 0 ? 0 : 1].stiffness == relative(mean, 0.02));
  }
}

TEST_CASE("a tip that comes too close to the root of its mate is told of, of lines and of strips") {
  Scene scene = read_scene("data/scenes/oh58-planetary.toml");
  scene.gears[0].design.dedendum = 1.25;
  scene.drives[0].torque = 1500;
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    CHECK(names(message_of([&] { coarsely_at_rest(scene, contact); }), {"sun"}));
  }
}
