// Friction of trains in motion: a pair told as a train, work, torques, the tangent; Newmark's method in trains.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "dynamics/dynamics.h"
#include "dynamics/lines_motion.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "friction_motion.h"
#include "gear/system_layout.h"
#include "orbits/periodic_motion.h"
#include "paper_pair.h"
#include "relative.h"
#include "solid/mesher.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFriction = 0.06, kPi = std::numbers::pi;
constexpr int kSteps = 96;
constexpr std::array<int, 3> kTeeth{26, 37, 100};
constexpr size_t kSun = 0, kRing = 4, kCarrier = 5;

// A gear of 20 or 30 teeth of the standard form.
const ReducedBody& gear_of(int teeth) {
  return kept_body(paper_gear(teeth, teeth < 25 ? 15e-3 : 25e-3), paper_steel(), 1.2e-3, 7);
}

double rms_of(const VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

// A motion of a system, its positions, and where it is.
struct Moving {
  Moving(SystemModel of, SystemMotion settings, int steps = kSteps)
      : system(cleared(std::move(of))), dynamics(system, std::move(settings)), count(steps) {
    dynamics.set_positions(std::vector<double>(system.mesh.size(), 60e-6), steps);
  }
  Moving(const Moving&) = delete;
  Moving& operator=(const Moving&) = delete;
  static SystemModel cleared(SystemModel of) {
    of.friction.clear();
    return of;
  }
  void start(double frequency, int periods) {
    state = dynamics.rest();
    dynamics.set_speed(frequency, count);
    run(periods);
  }
  void run(int periods, EnergyBalance* balance = nullptr) {
    for (int n = 0; n < periods; ++n) REQUIRE(dynamics.integrate(state, period, balance));
  }
  SystemModel system;
  SystemDynamics dynamics;
  int count;
  SystemDynamics::State state;
  SystemDynamics::Period period;
};

// 20 teeth driving 30, or 30 driving 20, as a pair and as a train whose gears both turn.
struct Both {
  Both(int driver, int driven, double coefficient, Integrator integrator, bool bearings, double torque = 60)
      : pair(gear_of(driver), gear_of(driven),
             static_transmission(gear_of(driver), gear_of(driven),
                                 settings(driver, driven, coefficient, bearings), torque),
             {3 * gear_of(driver).inertia, 2 * gear_of(driven).inertia}, integrator),
        train(model(driver, driven, torque), motion(torque)) {}

  static StaticParameters settings(int driver, int driven, double coefficient, bool bearings) {
    StaticParameters out = paper_statics(32);
    out.mesh.centre_distance = 1.5e-3 * (driver + driven);
    out.mesh.friction.coefficient = coefficient;
    out.fidelity.contact = ContactModel::line;
    if (bearings) out.mesh.bearing = {Bearing{200e6, 500, 0}, Bearing{120e6, 700, 0}};
    return out;
  }
  SystemModel model(int driver, int driven, double torque) const {
    SystemModel out(gear_of(driver), gear_of(driven), pair.statics.mesh);
    out.layout.drives = {{0, System::DriveKind::torque, torque},
                         {1, System::DriveKind::torque, -torque * driven / driver}};
    for (size_t g = 0; g < 2; ++g) out.layout.bodies[g].inertia = pair.inertia[g];
    return out;
  }
  SystemMotion motion(double torque) const {
    const SystemModel of = model(pair.model.kinematics.gear(0).design().teeth,
                                 pair.model.kinematics.gear(1).design().teeth, torque);
    SystemMotion out = motion_of(of, pair.statics.mean_stiffness, pair.eta());
    out.fidelity.integrator = pair.integrator;
    if (pair.statics.friction_coefficient > 0) {
      out.output = 1;
      out.loss = VectorXd::Constant(
          1, (1 - pair.statics.efficiency) / pair.statics.friction_coefficient * -of.layout.torque(1));
    }
    return out;
  }
  void start(double share, int periods) {
    const double frequency = share * natural_frequency(pair.statics, pair.inertia);
    CandidateZone zone;
    zone.corner_gap = 60e-6;
    pair.dynamics.set_zone(zone, kSteps);
    pair.state = pair.dynamics.rest();
    pair.dynamics.set_speed(frequency, kSteps);
    for (int n = 0; n < periods; ++n) REQUIRE(pair.dynamics.integrate(pair.state, pair.period));
    train.start(frequency, periods);
  }

  struct Pair {
    Pair(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& at_rest,
         const std::array<double, kSides>& of_gears, Integrator method)
        : statics(at_rest),
          model(driver, driven, statics.mesh),
          inertia(of_gears),
          integrator(method),
          dynamics(model, [&] {
            SweepParameters settings;
            settings.inertia = inertia;
            settings.damping.rayleigh_stiffness = eta();
            settings.fidelity = {BodyModel::modal, ContactModel::line, integrator};
            return dynamic_parameters(statics, statics.mean_stiffness, settings, 0);
          }()) {}
    double eta() const { return 0.03 / (2 * kPi * natural_frequency(statics, inertia)); }
    StaticResult statics;
    GearMeshModel model;
    std::array<double, kSides> inertia;
    Integrator integrator;
    RollingDynamics dynamics;
    RollingDynamics::State state;
    RollingDynamics::Period period;
  } pair;
  Moving train;
};

// The difference of the transmission errors of a mesh period, over their RMS.
double apart(const Both& both) {
  const VectorXd one = both.train.period.transmission_error.row(0),
                 other = both.pair.period.transmission_error;
  return (one - other).norm() / std::sqrt(static_cast<double>(kSteps)) / rms_of(other);
}

}  // namespace

TEST_CASE("a pair told as a train with friction moves as the pair, and so do its losses") {
  for (const auto& [driver, driven] : {std::pair{20, 30}, std::pair{30, 20}})
    for (const bool bearings : {false, true})
      for (const double share : {0.13, 0.93}) {
        INFO(driver << " teeth drive " << driven << ", bearings " << bearings << ", " << share << " f_n");
        Both both(driver, driven, kFriction, Integrator::exact, bearings);
        both.start(share, share < 0.5 ? 40 : 400);  // they start from other states, with and without friction
        REQUIRE(both.train.dynamics.friction()[0] == both.pair.dynamics.friction());
        EnergyBalance energy;
        EnergyBalance of_pair;
        both.train.run(1, &energy);
        REQUIRE(both.pair.dynamics.integrate(both.pair.state, both.pair.period, &of_pair));
        CHECK(apart(both) < 1e-5);
        CHECK(energy.friction[0] == relative(of_pair.friction[0], 1e-5));
        CHECK(energy.friction_rolling == relative(of_pair.friction_rolling, 1e-5));
        CHECK(both.train.period.drift_force == relative(both.pair.period.drift_force, 1e-4));
        CHECK(energy.imbalance < 1e-9 * energy.friction.sum());
        CHECK(std::abs(energy.left_over()) < 1e-9 * energy.friction.sum());
      }
}

namespace {

// Sun, three planets and a ring; tip edges out of reach unless `corner`.
SystemModel planetary(double coefficient, bool carrier_turns, bool corner = true, double of_carrier = 0) {
  return train(kTeeth, 3, {}, [&](Scene& scene) {
    const auto held = System::DriveKind::held, torque = System::DriveKind::torque;
    scene.drives = {
        {"sun", torque, kTrainTorque, 0},
        {"ring", held, 0, 0},
        {"carrier", carrier_turns ? torque : held, carrier_turns ? -kTrainTorque * 126 / 26 : 0, 0}};
    if (of_carrier > 0) scene.carriers[0].bearing = {of_carrier, 4000, 5.43};
    for (Scene::Mesh& mesh : scene.meshes) {
      mesh.spec.corner.enabled = corner;
      mesh.spec.friction.coefficient = coefficient;
    }
  });
}

// With the loss that the statics of lines have; the frame turns with its carrier.
SystemMotion with_losses(const SystemModel& system, double eta = 1e-6) {
  SystemMotion out = motion_of(system, 4e8, eta);
  out.frame_turns = frame_turns(system.layout);
  SystemModel still = system;
  take_friction(still);
  out.output = hold_output(still);
  if (out.output < 0) return out;
  out.loss = VectorXd::Zero(static_cast<Index>(system.mesh.size()));
  const double turned = 2 * kPi * ground_turns(system.layout, out.output);
  for (const SystemSolution& at : rest_over_period(still, ContactModel::line, 8, 16))
    for (size_t m = 0; m < system.mesh.size(); ++m)
      out.loss[static_cast<Index>(m)] += at.friction_work[m] / still.friction[m] / turned / 16;
  return out;
}

// 30, 20 and 30 teeth in line, the idler on a bearing; both ends turn.
SystemModel three_in_line(double coefficient) {
  Scene scene;
  for (const auto& [name, teeth] : {std::pair{"a", 30}, std::pair{"b", 20}, std::pair{"c", 30}}) {
    SceneGear gear;
    gear.name = name;
    gear.design = gear_of(teeth).design;
    gear.material = paper_steel();
    gear.total_inertia = 2 * gear_of(teeth).inertia;
    if (teeth == 20) gear.bearing = {200e6, 500, 0};
    scene.gears.push_back(gear);
  }
  for (const auto& [driver, driven] : {std::pair{"a", "b"}, std::pair{"b", "c"}}) {
    Scene::Mesh mesh;
    mesh.spec.gear = {driver, driven};
    mesh.spec.centre_distance = 75e-3;
    mesh.spec.friction.coefficient = coefficient;
    mesh.direction = scene.meshes.empty() ? 0.3 : 1.1;
    scene.meshes.push_back(mesh);
  }
  scene.drives = {{"a", System::DriveKind::torque, 90, 0}, {"c", System::DriveKind::torque, -90, 0}};
  System layout = layout_of(scene);
  layout.bodies[1].bearing.mass = 2 * gear_of(20).mass;
  return {layout, {gear_of(30), gear_of(20), gear_of(30)}, {scene.meshes[0].spec, scene.meshes[1].spec}};
}

}  // namespace

TEST_CASE("friction of trains in motion: the work balance closes with contact loss, whoever is held") {
  struct Case {
    const char* name;
    SystemModel system;
    double eta, frequency;
    bool loses;  // contact
  };
  for (const Case& of :
       {Case{"three in line", three_in_line(kFriction), 1e-6, 5200, true},
        Case{"planetary, carrier held", planetary(kFriction, false), 1e-7, 2400, true},
        Case{"planetary, carrier turns", planetary(kFriction, true, false, 2e8), 1e-7, 2400, false}}) {
    INFO(std::string(of.name));
    Moving moving(of.system, with_losses(of.system, of.eta));
    moving.start(of.frequency, 60);
    double least = 1e9;
    EnergyBalance energy;
    for (int n = 0; n < 6; ++n) {
      energy = {};
      moving.run(1, &energy);
      least = std::min(least, moving.period.mesh_force.minCoeff());
      CHECK(energy.imbalance < 1e-9 * energy.friction.sum());
      CHECK(std::abs(energy.left_over()) < 1e-9 * energy.friction.sum());
      CHECK(energy.friction.minCoeff() > 0);
    }
    if (of.loses) CHECK(least == 0);
  }
}

// The mean torques that bodies take are those of the drives, of what holds them, and of what holds the mean speed; what friction takes
// is the power that they leave, but for the work on the vibration.
TEST_CASE(
    "friction of trains in motion: efficiency by losses is that of the mean torques, and at low speed that of rest") {
  for (const bool carrier_turns : {false, true}) {
    CAPTURE(carrier_turns);
    const SystemModel system = planetary(kFriction, carrier_turns, false);
    Moving moving(system, with_losses(system, 3e-6), 192);
    moving.start(300, 30);
    EnergyBalance energy;
    moving.run(1, &energy);
    double in_frame = 0;  // J: what gears take in less what they give, in the frame of the carrier
    for (size_t b = 0; b < system.body.size(); ++b)
      in_frame += moving.period.contact_torque.row(static_cast<Index>(b)).mean() * 2 * kPi /
                  system.layout.bodies[b].teeth;
    CHECK(in_frame == relative(energy.friction_rolling, 1e-6));
    const double put_in = kTrainTorque * 2 * kPi / kTeeth[0], loss = energy.friction.sum() / put_in,
                 by_torques = in_frame / put_in;
    // At rest.
    SystemModel still = system;
    take_friction(still);
    hold_output(still);
    double rest = 0;
    for (const SystemSolution& at : rest_over_period(still, ContactModel::line, 8, 16))
      for (const double work : at.friction_work) rest += work / 16 / put_in;
    CHECK(loss == relative(by_torques, 4e-3));
    CHECK(loss == relative(rest, 6e-3));
    const double sun = moving.period.contact_torque.row(kSun).mean(),
                 ring = moving.period.contact_torque.row(kRing).mean(),
                 carrier = moving.period.contact_torque.row(kCarrier).mean();
    CHECK(sun == relative(kTrainTorque, 1e-3));
    // Counter-clockwise they are in balance; the carrier's follows from its pins.
    const auto sense = [&](size_t b) { return system.layout.bodies[b].sense; };
    CHECK(std::abs(sense(kSun) * sun + sense(kRing) * ring + sense(kCarrier) * carrier) < 1e-4 * sun);
    CHECK(-ring / sun * kTeeth[0] / kTeeth[2] == relative(1 - by_torques, 1e-4));
  }
}

TEST_CASE(
    "friction of trains in motion: a coefficient of 0, and free motion at a phase, have the bytes of no friction") {
  const auto bytes = [](double coefficient) {
    const SystemModel system = planetary(coefficient, false);
    Moving moving(system, with_losses(system));
    moving.start(2000, 3);
    return moving.state.z;
  };
  SystemModel none = planetary(0, false);
  for (GearMeshModel& mesh : none.mesh) mesh.friction = {};
  Moving without(none, with_losses(none));
  without.start(2000, 3);
  CHECK(bytes(0) == without.state.z);
  CHECK(bytes(kFriction) != without.state.z);
  const SystemModel system = planetary(kFriction, false);
  const auto at_a_phase = [](const SystemModel& of) {
    Moving moving(of, with_losses(of));
    moving.start(2000, 0);
    SystemDynamics::State state = moving.dynamics.rest(5);
    state.z *= 1.01;
    REQUIRE(moving.dynamics.integrate_fixed(5, state, 1e-6, 20, [](const auto&, const auto&) {}));
    return state.z;
  };
  CHECK(at_a_phase(system) == at_a_phase(none));
}

TEST_CASE("friction of trains in motion: the tangent of the period map is its derivative") {
  for (const bool carrier_turns : {false, true}) {
    const SystemModel system = planetary(kFriction, carrier_turns);
    Moving moving(system, with_losses(system), 48);
    SystemPeriodMap map(moving.dynamics, 48);
    map.set_parameter(1900);
    VectorXd state = map.rest();
    for (int n = 0; n < 40; ++n) state = map.apply(state);
    check_tangent(map, state, 2 * moving.dynamics.coordinates().size());
  }
}

TEST_CASE("Newmark's method in trains: a pair told as a train moves as the pair, the balance closes") {
  for (const double coefficient : {0.0, kFriction}) {
    Both both(20, 30, coefficient, Integrator::newmark, true);
    both.start(0.93, 400);
    EnergyBalance energy;
    both.train.run(1, &energy);
    REQUIRE(both.pair.dynamics.integrate(both.pair.state, both.pair.period));
    CHECK(apart(both) < 1e-5);
    CHECK(energy.imbalance < 1e-11 * energy.throughput);
    Both exact(20, 30, coefficient, Integrator::exact, true);
    exact.start(0.93, 401);
    CHECK((exact.train.period.transmission_error - both.train.period.transmission_error).norm() >
          1e-4 * exact.train.period.transmission_error.norm());
  }
}

// Between the two methods a mode at w has another frequency by (w h)^2 / 12 of it: of the second order.
TEST_CASE("Newmark's method in trains: of the second order against the exact propagators") {
  const SystemModel system = planetary(0, false, false);
  const auto motion_at = [&](Integrator integrator, int steps) {
    SystemMotion settings = motion_of(system, 4e8, 3e-6);
    settings.fidelity.integrator = integrator;
    Moving moving(system, settings, steps);
    moving.start(700, 40);
    VectorXd out(48);
    for (Index i = 0; i < 48; ++i) out[i] = moving.period.transmission_error(0, i * steps / 48);
    return out;
  };
  const auto difference = [&](int steps) {
    return (motion_at(Integrator::newmark, steps) - motion_at(Integrator::exact, steps)).norm();
  };
  const double coarse = difference(192), fine = difference(384), finest = difference(768);
  CHECK(std::log2(coarse / fine) == relative(2.0, 0.1));
  CHECK(std::log2(fine / finest) == relative(2.0, 0.1));
}
