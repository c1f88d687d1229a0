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
#include "io/system_scene.h"
#include "planetary_train.h"
#include "relative.h"
#include "scene_file.h"
#include "signal/spectrum.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/natural_modes.h"
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
const BodyArtifact& body_of(int teeth, bool internal) {
  static std::map<int, BodyArtifact> known;
  const auto at = known.find(teeth);
  if (at != known.end()) return at->second;
  BodyDiscretisation coarse;
  coarse.element_size = 2.5e-3;
  coarse.modes = 1;
  return known[teeth] = reduce(make_sector_mesh(elastic_gear(teeth, internal), coarse),
                               Material{206e9, 0.3, 7850, true}, 1);
}

// Sun, three planets and ring; the sun floats, planets stand on elastic pins; ring and carrier are held.
SystemScene train(const std::array<int, 3>& teeth, ContactModel contact, bool corner) {
  SystemScene scene = planetary_train(3);
  scene.fidelity = {BodyModel::modal, contact, Integrator::exact};
  scene.contact = {4, kPositions};
  const std::array stiffness{2e7, 3e8, 0.0};
  for (size_t g = 0; g < 3; ++g) {
    SystemScene::Gear& gear = scene.gears[g];
    gear.design = elastic_gear(teeth[g], g == 2);
    gear.material = {206e9, 0.3, 7850, true};
    gear.equivalent_mass = 0;
    gear.bearing = {stiffness[g], 0, 0};
  }
  scene.carriers[0].bearing = {};
  for (SystemScene::Mesh& mesh : scene.meshes) {
    mesh.spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * kModule;
    mesh.spec.corner.enabled = corner;
  }
  scene.drives = {{"sun", System::DriveKind::torque, kTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  return scene;
}

SystemStaticArtifact at_rest(const SystemScene& scene) {
  std::vector<BodyArtifact> bodies;
  for (const SystemScene::Gear& gear : scene.gears)
    bodies.push_back(body_of(gear.design.teeth, gear.design.internal));
  return system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies);
}

// Bodies of a train of three planets: 0 the sun, 1 to 3 the planets, 4 the ring, 5 the carrier.
constexpr Index kRing = 4, kCarrier = 5;

double torque_left(const SystemStaticArtifact& a, Index phase) {
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
    const SystemStaticArtifact a = at_rest(train({26, 37, 100}, contact, true));
    const double force = kTorque / ToothGeometry(elastic_gear(26, false)).base_radius();
    REQUIRE(a.mesh_phase.size() == kPositions);
    for (Index i = 0; i < kPositions; ++i) {
      CHECK(torque_left(a, i) < 1e-8 * kTorque);
      CHECK(a.torque(i, 0) == kTorque);
      CHECK(a.mesh_force.row(i).head(3).sum() == relative(force, 1e-9));
      CHECK(a.load_share.row(i).head(3).sum() == relative(1, 1e-12));
      // Contact forces of all gears come in pairs, so that bearings, pins and what holds the ring carry nothing together.
      const MatrixRM& bearing = a.bearing_force[static_cast<size_t>(i)];
      CHECK(bearing.topRows(5).colwise().sum().norm() < 1e-9 * force);
      CHECK((bearing.row(kCarrier) - bearing.middleRows(1, 3).colwise().sum()).norm() < 1e-12 * force);
      // Willis: of torques z_s and z_r, but for what tip edges change.
      CHECK(a.torque(i, kRing) == relative(-kTorque * 100 / 26, 0.01));
      CHECK(a.least_force[i] >= 0);
      CHECK(a.least_gap[i] > -1e-13);
      CHECK(a.torque_residual[i] < 1e-10);
      CHECK(a.tooth_load[static_cast<size_t>(i)].sum() > 2 * force * 0.99);
      CHECK(a.rotation(i, 0) > 0);
    }
  }
}

TEST_CASE(
    "equal planets with equal mesh phases: each carries a third at every phase, central bearings nothing") {
  const SystemStaticArtifact a = at_rest(train({27, 36, 99}, ContactModel::line, true));
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
    "sequential mesh phases: harmonic l turns the sun only where z_s l / N is whole, and pushes it only "
    "where "
    "it is not") {
  // z_s = 26, N = 3: a third of a mesh period later each planet does what the one before did, turned by a third.
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const SystemStaticArtifact a = at_rest(train({26, 37, 100}, contact, true));
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
    const SystemScene scene = train({26, 37, 100}, contact, false);
    const SystemStaticArtifact a = at_rest(scene);
    System layout = on_fixed_carriers(a.settings.layout);
    std::vector<BodyArtifact> bodies;
    std::vector<GearMeshSpec> specs;
    for (const System::Body& body : layout.bodies) bodies.push_back(body_of(body.teeth, body.teeth == 100));
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

TEST_CASE(
    "modes of an elastic train have the structure of the rigid one and lie within those of its phases") {
  const SystemStaticArtifact a = at_rest(train({27, 36, 99}, ContactModel::line, false));
  for (const System::Body& body : a.settings.layout.bodies)
    if (body.kind == System::BodyKind::gear) CHECK(body.inertia > 0);
  const ModesArtifact modes = elastic_modes(a);
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
  // Where stiffness is larger at every phase frequencies are (Courant and Fischer); the mean lies between.
  for (Index i = 0; i < 12; ++i) {
    CHECK(modes.natural_frequency[i] <= modes.frozen_frequency.col(i).maxCoeff() * (1 + 1e-9));
    CHECK(modes.natural_frequency[i] >= modes.frozen_frequency.col(i).minCoeff() * (1 - 1e-9));
    CHECK(modes.mesh_energy.row(i).sum() + modes.bearing_energy.row(i).sum() == relative(1, 1e-9));
  }
}

TEST_CASE("the four-planet set that ships and its rigid twin stand, turn and mesh alike") {
  const char *const elastic = "data/scenes/oh58-planetary.toml", *const rigid =
                                                                     "data/scenes/oh58-planetary-rigid.toml";
  const System a = layout_in(read_system_scene(elastic), elastic),
               b = layout_in(read_system_scene(rigid), rigid);
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
  // The elastic set has 1608.6 to 10015.6 Hz (make modes); the twin lacks what the sun's body joins.
  const ModesArtifact modes = natural_modes(b);
  CHECK(modes.natural_frequency[0] == relative(1608.576, 1e-3));
  CHECK(modes.natural_frequency[14] == relative(10015.64, 0.03));
}

TEST_CASE(
    "stage parameters of elastic systems: read as written; what a scene of elastic gears cannot have is "
    "rejected") {
  const char* const kTrain = "data/scenes/oh58-planetary.toml";
  const SystemScene scene = read_system_scene(kTrain);
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
    try {
      read_system_scene(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(said("").empty());
  CHECK(said("[gear.sun.modification]\ncrowning_um = 5\n").empty());
  CHECK(said("[gear.sun.error]\niso_class = 5\n").find("its teeth are all alike") != std::string::npos);
  CHECK(said("[gear.sun.crack]\ntooth = 1\ndepth_mm = 0.5\n").find("its teeth are all alike") !=
        std::string::npos);
  CHECK(said("[[bearing]]\ngear = \"carrier\"\nstiffness_N_um = 5.0\n").find("whose axis is rigid") !=
        std::string::npos);
  CHECK(said("[operation]\n").find("statics and natural modes are computed so far") != std::string::npos);
}
