// Sweeps, branches and ring-down of a planetary train: contact loss, energy, both ways, the same bytes again; orbits of the branch
// against the sweep; damping against closed forms.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>

#include "dynamics/lines_motion.h"
#include "dynamics/ring_down.h"
#include "gear/system_layout.h"
#include "io/artifacts.h"
#include "io/publish.h"
#include "io/scene.h"
#include "orbits/periodic_orbit.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "results/sweep.h"
#include "scene_file.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "small_system.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/branch.h"
#include "studies/sweep.h"
#include "studies/sweep_response.h"
#include "studies/system_impact.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::Index;

namespace {

constexpr double kModule = 2.776e-3;

// Three planets, 26, 37 and 100 teeth, lightly damped; coarse bodies, each reduced once.
struct Train {
  SystemSweepParameters settings;
  std::vector<ReducedBody> bodies;
};

const Train& train() {
  static const Train out = [] {
    Scene scene = planetary_train(3);
    const std::array teeth{26, 37, 100};
    const std::array stiffness{2e7, 3e8, 0.0};
    scene.fidelity = {BodyModel::modal, ContactModel::strips, Integrator::exact};
    scene.contact = {4, 12};
    scene.body.element_size = 3e-3;
    scene.body.modes = 15;
    Train train;
    for (size_t g = 0; g < 3; ++g) {
      SceneGear& gear = scene.gears[g];
      gear.design = rigid_gear(teeth[g], g == 2);
      if (g < 2) gear.design.bore_radius = (0.5 * teeth[g] - 5) * kModule;
      gear.material = {206e9, 0.3, 7850, true};
      gear.equivalent_mass = 0;
      gear.bearing = {stiffness[g], stiffness[g] > 0 ? 500.0 : 0.0, 0};
      train.bodies.push_back(kept_body(gear.design, gear.material, scene.body));
    }
    scene.carriers[0].bearing = {};
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * 63 * kModule;
    scene.drives = {{"sun", System::DriveKind::torque, 300, 0},
                    {"ring", System::DriveKind::held, 0, 0},
                    {"carrier", System::DriveKind::held, 0, 0}};
    scene.operation.frequency_from = 6600;
    scene.operation.frequency_to = 7200;
    scene.operation.frequency_step = 200;
    scene.damping.rayleigh_stiffness = 1e-6;
    scene.time.steps_per_period = 48;
    scene.time.min_sample_rate = 1;
    train.settings = sweep_parameters_of(scene, layout_of(scene));
    return train;
  }();
  return out;
}

std::string bytes_of(const SweepResult& a) {
  const SceneFile place;
  const std::string path = place.path("") + ".h5";
  write(path, a, Provenance());
  return read_bytes(path);
}

SweepResult swept(Direction direction, const SystemSweepParameters& settings = train().settings) {
  return system_sweep(settings, train().bodies, direction, [](auto&&...) {});
}

// Damping by Rayleigh's factors alone, without dampers of bearings.
SystemSweepParameters damped(double eta, double mu) {
  SystemSweepParameters out = train().settings;
  out.damping.rayleigh_stiffness = eta;
  out.damping.rayleigh_mass = mu;
  out.damping.bearing_ratio = 0;
  for (System::Body& body : out.layout.bodies) body.bearing.damping = 0;
  return out;
}

}  // namespace

TEST_CASE(
    "sweep of a planetary train: contact is lost, energy closes, both ways meet, two runs are identical") {
  const SweepResult up = swept(Direction::up), down = swept(Direction::down);
  REQUIRE(up.mesh_frequency.size() == 4);
  const ResponseResult rising = response(up), falling = response(down);
  CHECK(rising.separation_fraction.maxCoeff() > 0.01);
  for (const SweepResult* a : {&up, &down}) {
    CHECK(a->energy_imbalance.maxCoeff() < 1e-9);
    CHECK(a->least_gap > -1e-12);
    CHECK(a->bearing_damping.leftCols(4).minCoeff() > 0);
  }
  for (Index i = 0; i < 4; ++i) {
    CHECK(up.mesh_frequency[i] == down.mesh_frequency[3 - i]);
    REQUIRE(up.period_multiple[i] == 1);
    REQUIRE(down.period_multiple[3 - i] == 1);
    CHECK(up.residual[i] < 1e-5);
    for (Index m = 0; m < 6; ++m) CHECK(falling.dte_rms(3 - i, m) == relative(rising.dte_rms(i, m), 1e-3));
    // Nothing turns faster and faster: torques on what stands on the ground, drives and what holds.
    double all = 0;
    for (size_t b = 0; b < up.layout.bodies.size(); ++b)
      if (const System::Body& body = up.layout.bodies[b]; body.on == System::kGround)
        all += body.sense * (up.drive[static_cast<Index>(b)] + up.holding_torque(i, static_cast<Index>(b)));
    CHECK(std::abs(all) < 1e-3 * 300);
    CHECK(std::abs(up.holding_torque(i, 4)) == relative(300.0 * 100 / 26, 1e-3));
    CHECK((up.holding_torque.row(i).segment(1, 3).array() == 0).all());
    // The sun is driven by its torque, in the mean of the vibration, too; sharing is equal in the mean.
    CHECK(up.mesh_force[static_cast<size_t>(i)].leftCols(3).rowwise().sum().mean() ==
          relative(300 / up.layout.bodies[0].radius, 0.01));
    // Pins and sun and ring: the carrier has the sum of its pins.
    CHECK(up.bearing_force[5][static_cast<size_t>(i)] == up.bearing_force[1][static_cast<size_t>(i)] +
                                                             up.bearing_force[2][static_cast<size_t>(i)] +
                                                             up.bearing_force[3][static_cast<size_t>(i)]);
  }
  CHECK(bytes_of(up) == bytes_of(swept(Direction::up)));
}

// By sums over the stored rows, apart from the program's functions.
TEST_CASE(
    "what a sweep of a train says: each mesh and each body by sums over its rows, read back with its names") {
  const SweepResult a = swept(Direction::down);
  const SceneFile place;
  const std::string path = place.path("") + ".h5", answer = place.path("") + "-response.h5";
  write(path, a, Provenance());
  write(answer, response(read<SweepResult>(path)), Provenance());
  const ResponseResult r = read<ResponseResult>(answer);
  REQUIRE(r.of_train());
  REQUIRE(r.mesh_names.size() == 6);
  CHECK(r.mesh_names[1] == "sun-planet2");
  CHECK(r.body_names == std::vector<std::string>{"sun", "planet1", "planet2", "planet3", "ring", "carrier"});
  REQUIRE(r.harmonics() == 10);
  REQUIRE(r.root_stress_max.cols() == 12);
  CHECK(r.name_of_side(3) == "planet2");
  CHECK(r.friction.power.size() == 0);
  double parted = 0;
  for (Index i = 0; i < 4; ++i) {
    const auto at = static_cast<size_t>(i);
    const MatrixRM &error = a.transmission_error[at], &force = a.mesh_force[at];
    const Index n = error.rows();
    REQUIRE(n == 48);
    for (Index side = 0; side < 12; ++side) {
      CHECK(r.root_stress_max(i, side) == a.root_stress[at].col(side).maxCoeff());
      CHECK(r.root_stress_sustained(i, side) <= r.root_stress_max(i, side));
      CHECK(r.root_stress_sustained(i, side) > 0);
    }
    for (Index m = 0; m < 6; ++m) {
      double sum = 0, square = 0, most = 0, tooth = 0, apart = 0, share = 0;
      std::complex<double> second = 0;
      for (Index k = 0; k < n; ++k) {
        sum += error(k, m);
        second += error(k, m) * std::polar(1.0, -4 * std::numbers::pi * static_cast<double>(k) / 48);
        most = std::max(most, force(k, m));
        tooth = std::max(tooth, a.loads_of(i, m).row(k).maxCoeff());
        apart += force(k, m) > 0 ? 0 : 1;
        const double all = force.row(k).segment(m < 3 ? 0 : 3, 3).sum();
        if (all > 0) share = std::max(share, force(k, m) / all);
      }
      for (Index k = 0; k < n; ++k) square += std::pow(error(k, m) - sum / 48, 2);
      CHECK(r.dte_mean(i, m) == relative(sum / 48, 1e-12));
      CHECK(r.dte_rms(i, m) == relative(std::sqrt(square / 48), 1e-12));
      CHECK(r.dte_harmonic[at](1, m) == relative(std::abs(second) / 24, 1e-9));
      CHECK(r.mesh_force_max(i, m) == most);
      CHECK(r.tooth_load_max(i, m) == tooth);
      CHECK(tooth <= most * (1 + 1e-12));
      // Levers of tip edges differ from the base radius by a few per cent.
      CHECK((a.loads_of(i, m).rowwise().sum() - force.col(m)).cwiseAbs().maxCoeff() < 0.05 * most);
      CHECK(r.tooth_load_sustained(i, m) <= tooth);
      CHECK(r.tooth_load_sustained(i, m) > 0);
      CHECK(r.separation_fraction(i, m) == apart / 48);
      CHECK(r.load_share_max(i, m) == relative(share, 1e-12));
      parted += apart;
    }
    for (size_t b = 0; b < 6; ++b) {
      const MatrixRM& bearing = a.bearing_force[b][at];
      double x = 0, y = 0, square = 0, most = 0;
      for (Index k = 0; k < n; ++k) {
        x += bearing(k, 0) / 48;
        y += bearing(k, 1) / 48;
        most = std::max(most, std::hypot(bearing(k, 0), bearing(k, 1)));
      }
      for (Index k = 0; k < n; ++k) square += std::pow(bearing(k, 0) - x, 2) + std::pow(bearing(k, 1) - y, 2);
      CHECK(r.bearing_force_max(i, static_cast<Index>(b)) == relative(most, 1e-12));
      CHECK(std::abs(r.bearing_force_rms(i, static_cast<Index>(b)) - std::sqrt(square / 48)) < 1e-9 * most);
    }
  }
  CHECK(parted > 0);
}

// Nothing resonates at this speed: what is left of the statics' root stress are the free vibrations after each tooth that comes in.
TEST_CASE("slow motion of a planetary train with friction: root stress and efficiency are those at rest") {
  SystemSweepParameters settings = damped(4e-6, 3000);
  settings.set_friction({.coefficient = 0.06});
  settings.frequency_from = settings.frequency_to = 150;
  settings.contact.positions = 48;
  settings.fidelity.contact = ContactModel::line;
  const SweepResult slow = swept(Direction::up, settings);
  const SystemStaticResult rest = system_at_rest(settings, train().bodies);
  REQUIRE(slow.root_stress.size() == 1);
  for (size_t m = 0; m < 6; ++m)
    for (size_t side = 0; side < kSides; ++side) {
      const Eigen::VectorXd known = rest.mesh[m].root_stress[side].rowwise().maxCoeff(),
                            found = slow.root_stress[0].col(static_cast<Index>(kSides * m + side));
      REQUIRE(known.size() == found.size());
      INFO(m << " " << side << ": " << (found - known).cwiseAbs().maxCoeff() / known.maxCoeff());
      CHECK((found - known).cwiseAbs().maxCoeff() < 0.03 * known.maxCoeff());
    }
  CHECK(slow.friction.coefficient[0] == relative(0.06, 1e-12));
  CHECK(1 - slow.friction.efficiency[0] == relative(1 - rest.efficiency[5], 0.01));
}

TEST_CASE("losses of a planetary train in motion: the work of friction, and what the mean torques leave") {
  SystemSweepParameters settings = train().settings;
  settings.set_friction({.coefficient = 0.06});
  settings.damping.rayleigh_stiffness = 4e-6;
  settings.frequency_to = settings.frequency_from;
  const SweepResult a = swept(Direction::up, settings);
  REQUIRE(a.period_multiple[0] == 1);
  const double f = a.mesh_frequency[0];
  CHECK(a.friction.power[0] == relative(a.energy(0, energy_line("friction")) * f, 1e-12));
  CHECK(a.energy_imbalance[0] < 1e-9);
  Eigen::VectorXd torque = a.holding_torque.row(0).transpose();
  torque[0] = 300;
  const double by_torques = efficiency_at_rest(a.layout, torque, -1);
  // What dampers take of the vibration comes from the drives, too.
  double damped_away = 0;
  for (const Index line :
       {energy_line("modal_damping"), energy_line("bearing_damping"), energy_line("relaxation_damping")})
    damped_away += a.energy(0, line) * f;
  const double put_in = 300 * 2 * std::numbers::pi * f / 26,
               loss = 1 - a.friction.efficiency[0] + damped_away / put_in;
  INFO(a.friction.efficiency[0] << " by losses, " << loss << " with damping, " << by_torques
                                << " by torques");
  CHECK(a.friction.power[0] == relative((1 - a.friction.efficiency[0]) * put_in, 1e-9));
  CHECK(loss == relative(1 - by_torques, 0.01));
  const SceneFile place;
  const std::string path = place.path("") + ".h5";
  write(path, sweep_response(a), Provenance());
  const ResponseResult read = whine::read<ResponseResult>(path);
  CHECK(read.friction.power[0] == a.friction.power[0]);
  CHECK(read.friction.efficiency[0] == a.friction.efficiency[0]);
}

// The first planet has a cracked tooth. By kinematics it works once in a turn of its planet, of 37 mesh periods; the ring, which stands,
// sees the carrier go by once in 100.
TEST_CASE(
    "a cracked planet tooth in motion: sidebands of its turn in the meshes, of the carrier on the ring") {
  constexpr int kPlanet = 37, kTooth = 5;
  SystemSweepParameters settings = damped(4e-6, 3000);
  settings.frequency_from = settings.frequency_to = 700;
  std::vector<ReducedBody> bodies = train().bodies;
  GearDesign design = bodies[1].design;
  design.crack = {.tooth = kTooth, .depth = 2e-3};
  BodyDiscretisation coarse;
  coarse.element_size = 1.5e-3;
  coarse.modes = 15;
  bodies[1] = reduce(make_sector_mesh(design, coarse), Material{206e9, 0.3, 7850, true}, coarse.modes);
  REQUIRE(bodies[1].crack_compliance.size() > 0);
  const SweepResult a = system_sweep(settings, bodies, Direction::up, [](auto&&...) {});
  REQUIRE(a.hunting_periods == kPlanet);
  REQUIRE(a.period_multiple[0] == kPlanet);
  CHECK(a.energy_imbalance[0] < 1e-9);
  const ResponseResult r = response(a);
  // That of its own mesh with the sun is the largest: the other flank, which the ring works on, closes the crack.
  Index most = 0;
  r.residual_rms.row(0).maxCoeff(&most);
  CHECK(most == 0);
  MESSAGE("residual, nm: " << r.residual_rms.row(0) * 1e9 << "; kurtosis " << r.residual_kurtosis(0, 0));
  CHECK(r.residual_kurtosis(0, 0) > 6);
  // While the tooth is in mesh.
  Index at = 0;
  residual_signal(a.transmission_error[0].col(0), kPlanet).cwiseAbs().maxCoeff(&at);
  const int tooth = a.layout.meshes[0].side[1].tooth(-static_cast<int>(at) / 48);
  const int ahead = ((tooth - kTooth) % kPlanet + kPlanet) % kPlanet;
  CHECK(std::min(ahead, kPlanet - ahead) <= 1);
  // N: the line at an order of the force on the ring, in the frame of the ring, over 3700 mesh periods.
  const MatrixRM& force = a.bearing_force[4][0];
  const auto line = [&](double order) {
    std::complex<double> sum = 0;
    const Index all = 3700 * 48;
    for (Index i = 0; i < all; ++i) {
      const double mesh_periods = static_cast<double>(i) / 48;
      const Index row = i % force.rows();
      sum +=
          std::complex(force(row, 0), force(row, 1)) *
          std::polar(1.0, 2 * std::numbers::pi * mesh_periods * (a.layout.bodies[5].sense / 100.0 - order));
    }
    return std::abs(sum) / static_cast<double>(all);
  };
  const double pass = a.layout.bodies[5].sense / 100.0;
  for (const double order : {1 - 1.0 / kPlanet, 1 + 1.0 / kPlanet}) {
    CHECK(line(order + pass) > 1e4 * line(order));
    CHECK(line(order + pass) > 1e4 * line(order + 2 * pass));
  }
}

TEST_CASE("a sweep of a train whose rows do not fit each other is rejected with what does not") {
  const SweepResult good = small_sweep(small_system(), Direction::up);
  const auto said = [&](const auto& spoil) {
    SweepResult a = good;
    a.time.steps_per_period = 4;
    spoil(a);
    return message_of_input([&] { response(a); });
  };
  CHECK(names(said([](SweepResult& a) { a.mesh_frequency.resize(0); }), {"no speed"}));
  CHECK(names(said([](SweepResult& a) { a.mesh_force.pop_back(); }), {"mesh_force", 1, 2}));
  CHECK(names(said([](SweepResult& a) { a.tooth_load[1].resize(3, 12); }), {"tooth_load", 3, 4}));
  CHECK(names(said([](SweepResult& a) { a.bearing_force.pop_back(); }), {"bearing_force", 5, 6}));
  CHECK(names(said([](SweepResult& a) { a.section.pop_back(); }), {"[[mesh]]", 5, 6}));
  CHECK(names(said([](SweepResult& a) { a.section[0] = -1; }), {"[[mesh]]", -1}));
  CHECK(names(said([](SweepResult& a) { a.time.steps_per_period = 3; }), {4, 3}));
  CHECK(names(said([](SweepResult& a) { a.period_multiple[0] = 2; }), {"period_multiple", 2}));
}

TEST_CASE(
    "branch of a planetary train: its ends are the motions of the sweep, all along it they are stable") {
  SystemSweepParameters settings = train().settings;
  settings.frequency_from = 2550;
  settings.frequency_to = 2600;
  settings.frequency_step = 25;
  const BranchResult branch = system_branch(settings, train().bodies, [](auto&&...) {});
  const ResponseResult sweep = response(swept(Direction::down, settings));
  INFO(branch.end);
  const Index last = branch.mesh_frequency.size() - 1;
  REQUIRE(last >= 1);
  CHECK(branch.mesh_frequency[0] == relative(2600, 1e-9));
  CHECK(branch.mesh_frequency[last] == relative(2550, 1e-9));
  CHECK(branch.residual.maxCoeff() < 1e-6);
  CHECK(branch.stable.minCoeff() == 1);
  CHECK(branch.fold_frequency.size() == 0);
  for (Index m = 0; m < 6; ++m) {
    CHECK(branch.dte_rms(0, m) == relative(sweep.dte_rms(0, m), 1e-4));
    CHECK(branch.dte_rms(last, m) == relative(sweep.dte_rms(2, m), 1e-4));
    CHECK(branch.mesh_force_max(last, m) == relative(sweep.mesh_force_max(2, m), 1e-4));
    CHECK(branch.tooth_load_max(last, m) == relative(sweep.tooth_load_max(2, m), 1e-4));
    CHECK(branch.mesh_force_sustained(last, m) == relative(sweep.mesh_force_sustained(2, m), 0.02));
    CHECK(branch.tooth_load_sustained(last, m) == relative(sweep.tooth_load_sustained(2, m), 0.02));
    CHECK(branch.dte_harmonic[static_cast<size_t>(last)](0, m) ==
          relative(sweep.dte_harmonic[2](0, m), 1e-3));
  }
  for (Index b = 0; b < 6; ++b)
    CHECK(branch.bearing_force_rms(last, b) == relative(sweep.bearing_force_rms(2, b), 1e-3));
}

TEST_CASE(
    "orbits of a planetary train from a sweep's motion: both ways, on the branch from the highest speed") {
  SystemSweepParameters settings = train().settings;
  settings.frequency_from = 2550;
  settings.frequency_to = 2600;
  settings.frequency_step = 25;
  const auto follow = [&](const BranchPlan& plan) {
    return system_branch(
        settings, train().bodies, [](auto&&...) {}, plan);
  };
  const BranchResult branch = follow({.sweep = Direction::up, .at = 2575});
  INFO(branch.end);
  CHECK(branch.mesh_frequency[0] == relative(2575, 1e-12));
  REQUIRE(branch.part.maxCoeff() == 1);
  CHECK(branch.period_multiple.maxCoeff() == 1);
  const ResponseResult sweep = response(swept(Direction::up, settings));
  for (Index m = 0; m < 6; ++m) CHECK(branch.dte_rms(0, m) == relative(sweep.dte_rms(1, m), 1e-4));
  for (Index part = 0; part < 2; ++part) {
    Index last = branch.part.size() - 1;
    while (branch.part[last] != part) --last;
    const Index row = part == 0 ? 0 : 2;
    CHECK(branch.mesh_frequency[last] == relative(settings.frequency_from + 25.0 * row, 1e-9));
    CHECK(branch.dte_rms(last, 0) == relative(sweep.dte_rms(row, 0), 1e-4));
  }
  CHECK(failure_of([&] { follow({.sweep = Direction::up, .at = 1000}); }) == Failure::input);
  CHECK(failure_of([&] { follow({.most_periods = 3}); }) == Failure::input);
  CHECK(failure_of([&] { follow({.tolerance = 1}); }) == Failure::input);
}

TEST_CASE("orbits of a planetary train: where a contact begins to come or go its events are others") {
  SystemSweepParameters settings = train().settings;
  settings.frequency_from = 2400;
  settings.frequency_to = 2700;
  settings.frequency_step = 25;
  const BranchResult branch = system_branch(settings, train().bodies, [](auto&&...) {});
  MESSAGE(branch.grazing_frequency.size() << " grazing orbits; " << branch.end);
  REQUIRE(branch.grazing_frequency.size() > 0);
  const int positions = steps_at(settings.time, settings.frequency_from);
  LinesMotion rig(settings, train().bodies, positions);
  const int steps = steps_at(settings.time, settings.frequency_to);
  // Orbits a little below and above it, by Newton's method from the motion that integration settles into.
  const auto events_at = [&](double frequency, int mesh) {
    MotionState state = rig.rest();
    REQUIRE(rig.settle(state, frequency, steps, {settings.time.periodicity}));
    const std::unique_ptr<MotionMap> map = rig.map(steps);
    map->set_parameter(frequency);
    const OrbitSearch orbit = newton_orbit(*map, map->flat_of(state), 1, {});
    REQUIRE(orbit.found());
    map->apply(orbit.orbit.start);
    int count = 0;
    for (const ContactEvent& event : map->events()) count += map->place_of(event.contact).first == mesh;
    return count;
  };
  const double at = branch.grazing_frequency[0];
  const int mesh = branch.grazing_mesh[0];
  // A contact that comes opens and closes once; others of the mesh may do so close by.
  CHECK(std::abs(events_at(at - 1, mesh) - events_at(at + 1, mesh)) >= 2);
}

// A linear system with constant stiffness has the multipliers exp(s / f) of its roots s; the stiffness varies by some percent, and
// roots of the mean contact are those of the slowest mode at each phase, in the mean.
TEST_CASE("without contact loss the largest multiplier is the decay of the slowest mode") {
  SystemSweepParameters settings = damped(1e-6, 600);
  settings.frequency_from = 2590;
  settings.frequency_to = 2600;
  settings.frequency_step = 10;
  const BranchResult branch = system_branch(settings, train().bodies, [](auto&&...) {});
  REQUIRE(branch.separation_fraction.maxCoeff() == 0);
  LinesMotion rig(settings, train().bodies, 6);
  double slowest = 0;  // s-1
  for (int i = 0; i < 6; ++i) {
    double least = 1e9;
    for (const DampedRoot& root :
         damped_roots(rig.dynamics().frozen(i), rig.dynamics().frozen_modes(i).frequency.head(8)))
      least = std::min(least, 2 * std::numbers::pi * root.frequency * root.damping_ratio /
                                  std::sqrt(1 - root.damping_ratio * root.damping_ratio));
    slowest += least / 6;
  }
  for (Index i = 0; i < branch.mesh_frequency.size(); ++i)
    CHECK(std::log(branch.floquet_multiplier[static_cast<size_t>(i)].row(0).norm()) ==
          relative(-slowest / branch.mesh_frequency[i], 0.02));
}

TEST_CASE("ring-down of a planetary train: decays are eigenvalues, damping by mass is its closed form") {
  const double mu = 900;
  const ImpactResult a = system_impact(damped(0, mu), train().bodies, {8, 2, 1e-4}, [](auto&&...) {});
  REQUIRE(a.natural_frequency.cols() == 8);
  for (Index i = 0; i < 2; ++i)
    for (Index k = 0; k < 8; ++k) {
      const double w = 2 * std::numbers::pi * a.undamped_frequency(i, k), ratio = mu / (2 * w);
      CHECK(a.eigen_damping_ratio(i, k) == relative(ratio, 1e-6));
      CHECK(a.rayleigh_damping_ratio(i, k) == relative(ratio, 1e-12));
      CHECK(a.eigen_frequency(i, k) ==
            relative(a.undamped_frequency(i, k) * std::sqrt(1 - ratio * ratio), 1e-9));
      CHECK(a.natural_frequency(i, k) == relative(a.eigen_frequency(i, k), 2e-4));
      CHECK(a.damping_ratio(i, k) == relative(ratio, 2e-3));
    }
}

// To the first order in eta a mode q of unit modal mass has zeta = eta / (2 w) (what it stores twice over where Rayleigh's damping
// acts): w_i^2 q_i^2 of the coordinates, less bearings, and p^T R p of the relaxed flexibility under the forces p = A^-1 H q.
TEST_CASE("ring-down of a planetary train: damping by stiffness is the energy that it damps") {
  constexpr double kEta = 1e-7;
  const SystemSweepParameters settings = damped(kEta, 0);
  const ImpactResult a = system_impact(settings, train().bodies, {6, 1, 1e-4}, [](auto&&...) {});
  LinesMotion rig(settings, train().bodies, 1);
  const FixedPhaseMesh mesh = rig.dynamics().frozen(0);
  const SystemDynamics::FrozenModes modes = rig.dynamics().frozen_modes(0);
  for (Index k = 0; k < 6; ++k) {
    const Eigen::VectorXd q = modes.shape.col(k), p = Eigen::MatrixXd(mesh.local + mesh.residual)
                                                          .ldlt()
                                                          .solve(mesh.participation * q);
    const double w = 2 * std::numbers::pi * modes.frequency[k],
                 damped_energy = (mesh.damping / kEta).dot(q.cwiseAbs2()) + p.dot(mesh.residual * p);
    CHECK(modes.frequency[k] == relative(a.undamped_frequency(0, k), 1e-12));
    CHECK(a.eigen_damping_ratio(0, k) == relative(kEta * damped_energy / (2 * w), 1e-3));
    CHECK(a.damping_ratio(0, k) == relative(a.eigen_damping_ratio(0, k), 0.01));
    CHECK(a.damping_ratio(0, k) < a.rayleigh_damping_ratio(0, k));
  }
}
