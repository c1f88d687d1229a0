// Natural frequencies of rigid trains in the frame of a carrier that turns: closed forms, sums, limits.
#include "system/turning_modes.h"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "base/units.h"
#include "gear/system_layout.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "system/natural_modes.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kRadius = 0.1;

// A body on a bearing, on the ground or on a pin of the carrier, body 0, which stands first.
System::Body body_on(int on, double mass, double stiffness, double inertia, double angle = 0) {
  System::Body out;
  out.name = "body";
  out.teeth = 20;
  out.radius = 0.05;
  out.inertia = inertia;
  out.on = on;
  out.bearing = {stiffness, 0, mass};
  if (on >= 0) out.centre = {kRadius * std::cos(angle), kRadius * std::sin(angle)};
  return out;
}

// mass: of the carrier, on a bearing of `stiffness`; 0: on a rigid axis.
System on_carrier(double mass, double stiffness) {
  System out;
  out.bodies.push_back(body_on(System::kGround, mass, stiffness, 0.05));
  out.bodies[0].kind = System::BodyKind::carrier;
  out.bodies[0].radius = kRadius;
  return out;
}

// The frequencies above 0, Hz.
VectorXd moving(const System& layout, double omega) {
  const VectorXd all = turning_frequencies(rigid_system(layout), omega);
  return all.tail((all.array() > 0).count());
}

}  // namespace

TEST_CASE(
    "a planet alone on its pin, a central member alone on its bearing: sqrt(k / m) plus and minus Omega") {
  constexpr double kMass = 0.7, kStiffness = 3e7;
  const double w = std::sqrt(kStiffness / kMass);
  for (const double omega : {-400.0, 0.0, 10.0, 400.0}) {
    System planet = on_carrier(0, 0), central = on_carrier(0, 0);
    planet.drives.push_back({0, System::DriveKind::held, 0, 0});
    planet.bodies.push_back(body_on(0, kMass, kStiffness, 1e-3, 0.4));
    central.bodies.push_back(body_on(System::kGround, kMass, kStiffness, 1e-3));
    for (const System& one : {planet, central}) {
      const VectorXd f = moving(one, omega);
      REQUIRE(f.size() == 2);
      CHECK(f[0] == relative((w - std::abs(omega)) / kTwoPi, 1e-9));
      CHECK(f[1] == relative((w + std::abs(omega)) / kTwoPi, 1e-9));
    }
  }
  // Beyond sqrt(k / m) as well: the bearing stands on the ground, where nothing turns.
  System soft = on_carrier(0, 0);
  soft.bodies.push_back(body_on(System::kGround, kMass, 1e4, 1e-3));
  const double slow = std::sqrt(1e4 / kMass);
  const VectorXd f = moving(soft, 400);
  CHECK(f[0] == relative((400 - slow) / kTwoPi, 1e-9));
  CHECK(f[1] == relative((400 + slow) / kTwoPi, 1e-9));
}

TEST_CASE(
    "a carrier with planets on rigid pins, on its bearing: as one central member, and it turns freely") {
  constexpr double kStiffness = 8e7, kOmega = 300;
  System one = on_carrier(3, kStiffness);
  for (int n = 0; n < 3; ++n) one.bodies.push_back(body_on(0, 0.5, 0, 1e-3, kTwoPi * n / 3));
  const VectorXd f = moving(one, kOmega);
  const double w = std::sqrt(kStiffness / 4.5);
  REQUIRE(f.size() == 2);
  CHECK(f[0] == relative((w - kOmega) / kTwoPi, 1e-9));
  CHECK(f[1] == relative((w + kOmega) / kTwoPi, 1e-9));
}

TEST_CASE(
    "a carrier that turns freely with planets on elastic pins: its rigid rotation costs nothing at any speed") {
  System one = on_carrier(3, 8e7);
  for (int n = 0; n < 3; ++n) one.bodies.push_back(body_on(0, 0.5, 3e7, 1e-3, kTwoPi * n / 3));
  const RigidSystem rigid = rigid_system(one);
  VectorXd turn = VectorXd::Zero(rigid.freedoms());
  turn += rigid.rotation[0].transpose();
  for (size_t b = 1; b < 4; ++b)
    turn += rigid.translation[b].transpose() * pin_direction(rigid.layout, rigid.layout.bodies[b]);
  CHECK((rigid.stiffness * turn).norm() < 1e-9 * rigid.stiffness.norm());
  CHECK((rigid.centrifugal * turn).norm() < 1e-12 * (rigid.mass * turn).norm());
  // Of 12 freedoms the rotations of the planets and that of the whole are free.
  for (const double omega : {0.0, 200.0}) CHECK(moving(one, omega).size() == 8);
}

TEST_CASE(
    "a planetary train: frequencies at rest are those of its modes, at plus and minus Omega the same, squares by the trace") {
  for (const int planets : {3, 4}) {
    const System layout = layout_of(planetary_train(planets));
    const RigidSystem rigid = rigid_system(layout);
    const VectorXd rest = natural_modes(layout).natural_frequency;
    const VectorXd still = turning_frequencies(rigid, 0);
    for (Index i = 0; i < rest.size(); ++i) CHECK(std::abs(still[i] - rest[i]) < 1e-9 * rest.maxCoeff());
    const Eigen::LLT<MatrixXd> mass(rigid.mass);
    const MatrixXd g = mass.solve(rigid.gyroscopic);
    CHECK((rigid.gyroscopic + rigid.gyroscopic.transpose()).norm() == 0);
    for (const double omega : {50.0, 500.0}) {
      const VectorXd one = turning_frequencies(rigid, omega), other = turning_frequencies(rigid, -omega);
      for (Index i = 0; i < one.size(); ++i) CHECK(std::abs(one[i] - other[i]) < 1e-9 * one.maxCoeff());
      const double squares = (kTwoPi * one).squaredNorm(),
                   sum = mass.solve(rigid.stiffness - omega * omega * rigid.centrifugal).trace() -
                         2 * omega * omega * (g * g).trace();
      CHECK(squares == relative(sum, 1e-9));
      // Coriolis terms are of first order in Omega, and split double modes.
      CHECK((one - still).cwiseAbs().maxCoeff() > 0.5 * omega / kTwoPi);
      CHECK((one - still).cwiseAbs().maxCoeff() < 1.05 * omega / kTwoPi);
    }
  }
}

TEST_CASE(
    "frequencies of a train over the speed of its carrier are part of its modes where one gear is held") {
  ModesResult modes = natural_modes(layout_of(planetary_train(4)));
  add_turning_frequencies(modes, {});
  CHECK(modes.frame_turns == 0.01);  // against the ring of 100 teeth
  REQUIRE(modes.turning_frequency.rows() == modes.turning_mesh_frequency.size());
  REQUIRE(modes.turning_mesh_frequency.size() == 65);
  CHECK((modes.turning_frequency.row(0).transpose() - modes.natural_frequency).cwiseAbs().maxCoeff() < 1e-6);
  const VectorXd last =
      turning_frequencies(rigid_system(modes.layout), kTwoPi * 0.01 * modes.turning_mesh_frequency[64]);
  CHECK(modes.turning_frequency.row(64).transpose() == last);
  // The Campbell diagram has a curve of each, and harmonics meet the curves.
  const Figure figure = campbell_figure(modes);
  REQUIRE(figure.blocks.size() == 4);
  CHECK(figure.blocks[3].name == "turning");
  const FigureBlock& crossings = figure.blocks[1];
  REQUIRE(!crossings.rows.empty());
  for (const auto& row : crossings.rows) {
    const VectorXd f = turning_frequencies(rigid_system(modes.layout), kTwoPi * 0.01 * row[2]);
    CHECK(row[3] == relative(row[1] * row[2], 1e-12));
    CHECK(std::abs(f[static_cast<Index>(row[0]) - 1] - row[3]) < 1e-3 * row[3]);
  }
  Scene scene = planetary_train(4);
  scene.drives.push_back({"carrier", System::DriveKind::held, 0, 0});
  ModesResult held = natural_modes(layout_of(scene));
  add_turning_frequencies(held, {});
  CHECK(held.frame_turns == 0);
  CHECK(held.turning_frequency.size() == 0);
}

TEST_CASE("which way and how fast the frame of a layout turns") {
  const auto turns = [](const std::vector<Scene::Drive>& drives) {
    Scene scene = planetary_train(3);
    scene.drives = drives;
    return frame_turns(layout_of(scene));
  };
  const auto held = System::DriveKind::held;
  // The sun turns counter-clockwise in the frame, the ring against it: the carrier goes round with the sun, against it where the sun is held.
  CHECK(turns({{"ring", held, 0, 0}}) == relative(1.0 / 99, 1e-15));
  CHECK(turns({{"ring", held, 0, 1e9}}) == relative(1.0 / 99, 1e-15));
  CHECK(turns({{"sun", held, 0, 0}}) == relative(-1.0 / 27, 1e-15));
  CHECK(turns({{"sun", held, 0, 0}, {"ring", held, 0, 0}}) == 0);
  CHECK(turns({{"ring", held, 0, 0}, {"carrier", held, 0, 0}}) == 0);
  CHECK(turns({}) == 0);
  const Scene scene = [] {
    Scene of = planetary_train(3);
    of.drives = {{"ring", System::DriveKind::held, 0, 0}};
    return of;
  }();
  const System layout = layout_of(scene);
  const TrainSpeeds speeds = train_speeds(layout);
  for (size_t b = 0; b < layout.bodies.size(); ++b)
    if (layout.bodies[b].kind == System::BodyKind::carrier) CHECK(speeds.turns[b] == frame_turns(layout));
}
