// Position errors of planets' pins: load sharing by hand, the reciprocity of pins and torques, statics beside motion; scene, layout
// and stage parameters of [[pin]].
#include <doctest/doctest.h>

#include "elastic_train.h"
#include "gear/layout.h"
#include "io/scene.h"
#include "io/variant.h"
#include "own_folder.h"
#include "refusal.h"
#include "relative.h"
#include "studies/study_variant.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

constexpr double kError = 5e-6;  // m

// One planet's pin off; sun: stiffness of its bearing, N m-1, 0: fixed.
SystemModel train_with_pin(int planets, double radial, double tangential, double sun,
                           double torque = kTrainTorque) {
  const std::array<int, 3> teeth = planets == 4 ? std::array{28, 36, 100} : std::array{27, 36, 99};
  return train(teeth, planets, {}, [&](Scene& scene) {
    scene.pins = {{"planet1", radial, tangential}};
    scene.gears[0].bearing = sun > 0 ? Bearing{sun, 0, 0} : Bearing{};
    scene.drives[0].torque = torque;
  });
}

struct Rest {
  VectorXd sun_mesh;  // (planet) N
  double sun = 0;     // m: r theta of the sun
  Vec2 pin;           // N: of planet 1 on its pin
};
Rest at_rest(const SystemModel& system, int planets) {
  const SystemSolution at = rest_over_period(system, ContactModel::line, 8, 4)[1];
  return {Eigen::Map<const VectorXd>(at.driving_force.data(), planets), at.equilibrium.x[0],
          at.bearing_force[1]};
}

// N m-1: of the path from the sun by one planet to the ring, from sun and torque; all paths are alike.
double path_stiffness(int planets) {
  const Rest more = at_rest(train_with_pin(planets, 0, 0, 0, 1.01 * kTrainTorque), planets),
             less = at_rest(train_with_pin(planets, 0, 0, 0, 0.99 * kTrainTorque), planets);
  return (more.sun_mesh[0] - less.sun_mesh[0]) / (more.sun - less.sun);
}

}  // namespace

TEST_CASE(
    "a pin that is off tangentially unloads its planet as springs side by side say; a floating sun evens three planets out") {
  // Planet 1 lags by delta = e (cos a_s + cos a_r) along its two lines of action, so F_n = k (x - delta_n) + what the sun's shift adds.
  const double cosine = std::cos(24.6 * std::numbers::pi / 180), delta = 2 * kError * cosine;
  for (const int planets : {3, 4}) {
    CAPTURE(planets);
    const double k = path_stiffness(planets),
                 mean = at_rest(train_with_pin(planets, 0, 0, 0), planets).sun_mesh.mean();
    const VectorXd fixed = at_rest(train_with_pin(planets, 0, kError, 0), planets).sun_mesh.array() - mean,
                   floating =
                       at_rest(train_with_pin(planets, 0, kError, 1e3), planets).sun_mesh.array() - mean;
    // The planets share sun and ring, whose own bending the springs leave out: 6 %.
    const double unit = k * delta / planets;
    CHECK(fixed.sum() == relative(0, 1e-9).scale(mean));
    CHECK(fixed[0] == relative(-(planets - 1) * unit, 0.06));
    for (int n = 1; n < planets; ++n) CHECK(fixed[n] == relative(unit, 0.12));
    if (planets == 3) {
      CHECK(floating.cwiseAbs().maxCoeff() < 0.01 * unit);
    } else {
      // The sun's shift evens opposite planets out: K_gamma = 1 + k delta / (4 F).
      for (int n = 0; n < planets; ++n) CHECK(floating[n] == relative(n % 2 == 0 ? -unit : unit, 0.06));
    }
  }
}

TEST_CASE(
    "a pin that is off radially, with equal pressure angles of both meshes, changes no load: they close by as much as they open") {
  const double mean = at_rest(train_with_pin(3, 0, 0, 0), 3).sun_mesh.mean();
  const VectorXd off = at_rest(train_with_pin(3, kError, 0, 0), 3).sun_mesh.array() - mean;
  const VectorXd tangential = at_rest(train_with_pin(3, 0, kError, 0), 3).sun_mesh.array() - mean;
  CHECK(off.cwiseAbs().maxCoeff() < 0.02 * tangential.cwiseAbs().maxCoeff());
}

TEST_CASE(
    "pins and torques are reciprocal: what an error of a pin turns the sun by is what a force on the sun presses the pin with") {
  constexpr double kStep = 1e-8, kPart = 1e-3;  // m; 1
  const auto sun = [](double e) { return at_rest(train_with_pin(4, 0, e, 2e7), 4).sun; };
  const auto pressed = [](double part) {  // tangentially, of planet 1, which stands on the x axis
    return at_rest(train_with_pin(4, 0, 0, 2e7, kTrainTorque * (1 + part)), 4).pin.y();
  };
  const SystemModel system = train_with_pin(4, 0, 0, 2e7);
  const double force = kTrainTorque / system.base_radius(0);  // N
  const double turned = (sun(kStep) - sun(-kStep)) / (2 * kStep),
               slope = (pressed(kPart) - pressed(-kPart)) / (2 * kPart * force);
  REQUIRE(std::abs(slope) > 0.1);
  CHECK(turned == relative(slope, 1e-5));
}

TEST_CASE("statics and motion have the same forces where a pin is off") {
  const SystemModel system = train_with_pin(4, 2e-6, kError, 2e7);
  const SystemMotion motion = motion_of(system, 3e8);
  SystemDynamics dynamics(system, motion);
  dynamics.set_positions(std::vector<double>(system.mesh.size(), 20e-6), 48);
  check_rest(dynamics, rest_over_period(system, ContactModel::line, 8, 16));
}

namespace {

const char* const kScene = "data/scenes/oh58-planetary.toml";

Scene with(const std::vector<std::string>& changes) {
  return read_variant_of(kScene, scene_variant(kScene, changes));
}

}  // namespace

TEST_CASE(
    "[[pin]] turns with the position of its planet, and stage parameters hold it where it is not 0 alone") {
  const Scene off = with({"pin.planet2.tangential_um=20", "pin.planet2.radial_um=-5"});
  const System layout = layout_of(off), plain = layout_of(read_scene(kScene));
  const double angle = std::atan2(layout.bodies[2].centre[1], layout.bodies[2].centre[0]);
  REQUIRE(layout.bodies[2].name == "planet2");
  CHECK(layout.bodies[2].offset[0] == relative(-5e-6 * std::cos(angle) - 20e-6 * std::sin(angle), 1e-12));
  CHECK(layout.bodies[2].offset[1] == relative(-5e-6 * std::sin(angle) + 20e-6 * std::cos(angle), 1e-12));
  CHECK(layout.bodies[1].offset == std::array{0.0, 0.0});
  const std::string words = system_static_parameters(static_parameters_of(off, layout));
  CHECK(contains(words, "[offset_planet2]"));
  CHECK(!contains(words, "[offset_planet1]"));
  CHECK(!contains(system_static_parameters(static_parameters_of(off, plain)), "offset"));
  const TemporaryFolder folder;
  const SystemStaticParameters back = read_system_static_parameters(folder.file("static.toml", words));
  CHECK(back.layout.bodies[2].offset == layout.bodies[2].offset);
}

TEST_CASE("a [[pin]] of no planet, given twice, too large or of rigid gears is rejected") {
  const auto why = [](const std::vector<std::string>& changes) {
    return message_of([&] { layout_of(with(changes)); });
  };
  CHECK(names(why({"pin.planet5.radial_um=1"}), {"planet5", "planet1, planet2, planet3, planet4"}));
  CHECK(names(why({"pin.sun.radial_um=1"}), {"[[pin]]", "sun", "planet4"}));
  CHECK(names(why({"pin.planet1.radial_um=2000"}), {"radial_um", 2000, 1000}));
  Scene twice = read_scene(kScene);
  twice.pins = {{"planet1", 1e-6, 0}, {"planet1", 0, 1e-6}};
  CHECK(names(message_of([&] { layout_of(twice); }), {"planet1", "one"}));
  const char* const rigid = "data/scenes/oh58-planetary-rigid.toml";
  CHECK(names(message_of([&] { read_variant_of(rigid, scene_variant(rigid, {"pin.planet1.radial_um=1"})); }),
              {"[pin]", "rigid"}));
}
