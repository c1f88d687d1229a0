// Friction in trains at rest: torques and pin forces in balance, work, efficiencies by losses, by torques and by their closed form.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "elastic_train.h"
#include "gear/layout.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "system/statics.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFriction = 0.08;
constexpr std::array<int, 3> kTeeth{26, 37, 100};
constexpr size_t kSun = 0, kRing = 4, kCarrier = 5;

// ring_drives: the sun is held, and planets push it; else the ring is held. The carrier is held. Tip edges are left out.
SystemModel train_of(double coefficient, bool ring_drives = false, double stiffness_of_carrier = 0,
                     const Bearing& of_ring = {}) {
  SystemModel out = train(kTeeth, 3, of_ring, [&](Scene& scene) {
    const auto held = System::DriveKind::held, torque = System::DriveKind::torque;
    if (ring_drives) {
      scene.meshes[0].spec.gear = {"ring", "planet"};
      scene.meshes[1].spec.gear = {"planet", "sun"};
    }
    scene.drives = {{ring_drives ? "ring" : "sun", torque, kTrainTorque, 0},
                    {ring_drives ? "sun" : "ring", held, 0, 0},
                    {"carrier", held, 0, 0}};
    if (stiffness_of_carrier > 0) scene.carriers[0].bearing = {stiffness_of_carrier, 4000, 5.43};
    for (Scene::Mesh& mesh : scene.meshes) {
      mesh.spec.corner.enabled = false;
      mesh.spec.friction.coefficient = coefficient;
    }
  });
  take_friction(out);
  return out;
}

struct Sums {
  VectorXd torque;  // (body) N m in its sense, of what drives and holds it, from the forces on its teeth
  double in_frame = 0, loss = 0;  // J in a mesh period
  Vec2 force = Vec2::Zero();      // N on the ground
};
Sums sums(const SystemModel& system, const SystemSolution& at) {
  Sums out;
  out.torque = VectorXd::Zero(static_cast<Index>(system.layout.bodies.size()));
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const auto& side = system.layout.meshes[m].side;
    out.torque[side[0].body] += at.driving_force[m] * system.base_radius(side[0].body);
    out.torque[side[1].body] -= at.driven_force[m] * system.base_radius(side[1].body);
    out.loss += at.friction_work[m];
  }
  const System::Body& carrier = system.layout.bodies[kCarrier];
  for (size_t b = 0; b < kCarrier; ++b) {
    const System::Body& body = system.layout.bodies[b];
    out.force += at.bearing_force[b];
    out.in_frame += out.torque[static_cast<Index>(b)] * 2 * std::numbers::pi / body.teeth;
    if (body.on == System::kGround) continue;
    const double x = body.centre[0] - carrier.centre[0], y = body.centre[1] - carrier.centre[1];
    out.torque[kCarrier] -= carrier.sense * (x * at.bearing_force[b].y() - y * at.bearing_force[b].x());
  }
  return out;
}

}  // namespace

TEST_CASE(
    "friction in a planetary train: torques and forces are in balance, and the work put in less the work given is the loss") {
  for (const auto contact : {ContactModel::line, ContactModel::strips})
    for (const bool ring_drives : {false, true})
      for (const double stiffness : {0.0, 2e8}) {
        if (contact == ContactModel::strips && (ring_drives || stiffness == 0)) continue;
        INFO(contact << (ring_drives ? ", ring drives" : ", sun drives") << ", carrier on " << stiffness);
        const Bearing of_ring = stiffness > 0 && !ring_drives ? Bearing{5e8, 2000, 0} : Bearing{};
        const SystemModel system = train_of(kFriction, ring_drives, stiffness, of_ring);
        REQUIRE(system.friction == std::vector<double>(6, kFriction));
        for (const SystemSolution& at :
             rest_over_period(system, contact, 8, contact == ContactModel::line ? 4 : 2)) {
          const Sums of = sums(system, at);
          CHECK(at.equilibrium.residual < 1e-9);
          const double driving = kTrainTorque;
          double balance = 0;
          for (size_t b = 0; b < system.layout.bodies.size(); ++b) {
            const System::Body& body = system.layout.bodies[b];
            if (body.on == System::kGround)
              balance += body.sense * of.torque[static_cast<Index>(b)];
            else
              CHECK(std::abs(of.torque[static_cast<Index>(b)]) < 1e-8 * driving);
          }
          CHECK(std::abs(balance) < 1e-8 * driving);
          CHECK(of.torque[0] == relative(driving, 1e-9));
          CHECK(of.force.norm() < 1e-8 * driving / system.base_radius(0));
          const double put_in = driving * 2 * std::numbers::pi / system.layout.bodies[0].teeth;
          CHECK(std::abs(of.in_frame - of.loss) < 1e-9 * put_in);
          CHECK(of.loss > 1e-3 * put_in);
        }
      }
}

TEST_CASE(
    "efficiencies of a planetary train: by losses, by torques, and from the basic efficiency in closed form") {
  const SystemModel system = train_of(kFriction);
  VectorXd torque = VectorXd::Zero(6);
  double loss = 0;
  const auto solutions = rest_over_period(system, ContactModel::line, 8, 16);
  for (const SystemSolution& at : solutions) {
    const Sums of = sums(system, at);
    torque += of.torque / 16;
    loss += of.loss / 16;
  }
  const System& layout = system.layout;
  const auto efficiency = [&](int at_rest) { return efficiency_at_rest(layout, torque, at_rest); };
  // Revolutions in a mesh period, counter-clockwise: in, out, and in the frame of what is at rest.
  const double n_s = 1.0 / kTeeth[0], n_r = -1.0 / kTeeth[2], turn = 2 * std::numbers::pi;
  const double basic = efficiency(kCarrier), ratio = static_cast<double>(kTeeth[2]) / kTeeth[0];
  CHECK(basic > 0.95);
  CHECK(basic < 0.999);
  CHECK(basic == relative(-torque[kRing] / kTeeth[2] / (torque[kSun] / kTeeth[0]), 1e-12));
  CHECK(1 - basic == relative(loss / (turn * torque[kSun] * n_s), 1e-9));
  // The ring at rest, from the sun to the carrier: eta = (1 + eta_0 z_r / z_s) / (1 + z_r / z_s).
  CHECK(efficiency(kRing) == relative((1 + basic * ratio) / (1 + ratio), 1e-9));
  CHECK(1 - efficiency(kRing) == relative(loss / (turn * torque[kSun] * (n_s - n_r)), 1e-9));
  // The sun at rest: what the ring gives in its frame is given by the carrier, which now drives: the flow in the frame stays.
  const double of_ring = -layout.bodies[kRing].sense * torque[kRing] * (n_r - n_s),
               of_carrier = layout.bodies[kCarrier].sense * torque[kCarrier] * (0 - n_s);
  CHECK(of_carrier - of_ring == relative(loss / turn, 1e-6));
  CHECK(efficiency(kSun) == relative(of_ring / of_carrier, 1e-9));
  // Of the first order in the coefficient.
  const auto half = rest_over_period(train_of(kFriction / 2), ContactModel::line, 8, 16);
  double less = 0;
  for (const SystemSolution& at : half) less += sums(system, at).loss / 16;
  CHECK(less == relative(loss / 2, 0.02));
}

TEST_CASE("a pair told as a train with friction is the pair") {
  for (const auto contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    StaticParameters settings = paper_statics(16);
    settings.mesh.friction.coefficient = kFriction;
    settings.fidelity.contact = contact;
    const ReducedBody& body = paper_body(40e-3, 1.2e-3, 12);
    const StaticResult pair = static_transmission(body, body, settings, 150);
    Scene scene;
    for (const char* name : {"pinion", "wheel"}) {
      SceneGear gear;
      gear.name = name;
      gear.design = paper_gear();
      gear.material = paper_steel();
      scene.gears.push_back(gear);
    }
    scene.meshes.resize(1);
    scene.meshes[0].spec = settings.mesh;
    scene.drives = {{"pinion", System::DriveKind::torque, 150, 0}, {"wheel", System::DriveKind::held, 0, 0}};
    SystemModel train(layout_of(scene), {body, body}, {settings.mesh});
    take_friction(train);
    const auto solutions = rest_over_period(train, contact, settings.contact.strips, 16);
    double loss = 0;
    for (size_t i = 0; i < solutions.size(); ++i) {
      CHECK(solutions[i].transmission_error[0] ==
            relative(pair.transmission_error[static_cast<Index>(i)], 1e-9));
      const double wanted = pair.friction_loss[static_cast<Index>(i)] * 2 * std::numbers::pi / 50;
      CHECK(std::abs(solutions[i].friction_work[0] - wanted) < 1e-9 * 150 * 2 * std::numbers::pi / 50);
      loss += solutions[i].friction_work[0] / 16;
    }
    CHECK(1 - loss / (150 * 2 * std::numbers::pi / 50) == relative(pair.efficiency, 1e-12));
  }
}

TEST_CASE(
    "without friction a train has the bits that it had; one that rolls is refused until its output is held") {
  const SystemModel none = train_of(0);
  CHECK(!none.slides());
  SystemModel rolls = train(kTeeth, 3, {}, [](Scene& scene) {
    scene.drives = {{"sun", System::DriveKind::torque, kTrainTorque, 0},
                    {"ring", System::DriveKind::held, 0, 0},
                    {"carrier", System::DriveKind::torque, -kTrainTorque * 126 / 26, 0}};
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.friction.coefficient = kFriction;
  });
  take_friction(rolls);
  CHECK(names(message_of([&] { rest_over_period(rolls, ContactModel::line, 8, 1); }), {"roll", "held"}));
  SystemModel held = rolls;
  CHECK(hold_output(held) == static_cast<int>(kCarrier));
  CHECK(rest_over_period(held, ContactModel::line, 8, 1)[0].equilibrium.residual < 1e-9);
  // What does not roll is as it was.
  SystemModel still = train_of(kFriction);
  CHECK(hold_output(still) == -1);
}
