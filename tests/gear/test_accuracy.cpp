// What an accepted error chooses: bounds kept, keys that are given kept, refusals by name. What the bounds are worth on whole sweeps is in
// tests/bench/verify_accuracy.cpp.
#include "gear/accuracy.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

constexpr double kDigits = 1e-9;  // settings are chosen to ten digits

Scene paper_scene(double accepted) {
  Scene scene;
  scene.gears = {paper_scene_gear("pinion"), paper_scene_gear("wheel")};
  scene.meshes.resize(1);
  scene.mesh() = paper_statics(8).mesh;
  scene.operation = {{600, 4000, 20}, {100}};
  scene.time.accepted_error = accepted;
  return scene;
}

KeyGiven only(std::set<std::string> keys) {
  return [keys = std::move(keys)](const std::string& key) { return keys.contains(key); };
}

}  // namespace

TEST_CASE("an accepted error: the bounds of what is chosen stay below it and near it, finer for less") {
  double element = 1, rate = 0;
  int modes = 0, flank_points = 0;
  for (const double accepted : {0.1, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005}) {
    CAPTURE(accepted);
    Scene scene = paper_scene(accepted);
    choose_discretisation(scene, only({}));
    const double bound = discretisation_plan(scene, only({})).error();
    CHECK(bound <= accepted * (1 + kDigits));
    CHECK(bound > 0.8 * accepted);
    CHECK(scene.body.element_modules <= element);
    CHECK(scene.body.modes >= modes);
    CHECK(scene.body.flank_points >= flank_points);
    if (accepted >= 0.01) CHECK(scene.body.flank_points == BodyDiscretisation{}.flank_points);
    CHECK(scene.time.min_sample_rate > rate);
    CHECK(scene.contact.strips % 4 == 0);
    element = scene.body.element_modules;
    modes = scene.body.modes;
    flank_points = scene.body.flank_points;
    rate = scene.time.min_sample_rate;
  }
  Scene untold = paper_scene(0);
  choose_discretisation(untold, only({}));
  CHECK(untold.body.element_size == 0);
  CHECK(untold.body.element_modules == 0);
  CHECK(untold.body.modes == Scene().body.modes);
  CHECK(untold.time.min_sample_rate == Scene().time.min_sample_rate);
}

TEST_CASE("an accepted error: keys that the scene gives stay, and the others make up for them") {
  Scene open = paper_scene(0.01), given = paper_scene(0.01);
  given.body.modes = 47;
  given.contact.strips = 5;
  choose_discretisation(open, only({}));
  choose_discretisation(given, only({"modes", "strips"}));
  CHECK(given.body.modes == 47);
  CHECK(given.contact.strips == 5);
  CHECK(given.time.min_sample_rate > open.time.min_sample_rate);
  CHECK(discretisation_plan(given, only({"modes", "strips"})).error() <= 0.01 * (1 + kDigits));
  Scene coarse = paper_scene(0.005);
  coarse.body.modes = 9;
  choose_discretisation(coarse, only({"modes"}));
  CHECK(discretisation_plan(coarse, only({"modes"})).error() > 0.005);  // told, not hidden
}

TEST_CASE(
    "a scene that says nothing accepts 1 %: what it gives stays and moves no other setting, and what has no law keeps its default") {
  Scene asked = paper_scene(kAcceptedError), silent = paper_scene(0);
  choose_discretisation(asked, only({}));
  choose_by_default(silent, only({}));
  CHECK(silent.time.accepted_error == kAcceptedError);
  CHECK(discretisation_plan(silent, only({})).error() <= kAcceptedError * (1 + kDigits));
  CHECK(discretisation_plan(silent, only({})).error() > 0.8 * kAcceptedError);
  CHECK(silent.time.steps_per_period == asked.time.steps_per_period);
  Scene given = paper_scene(0);
  given.contact.strips = 21;
  given.body.element_size = 0.1e-3;
  choose_by_default(given, only({"strips", "element_mm"}));
  CHECK(given.contact.strips == 21);
  CHECK(given.body.element_size == 0.1e-3);
  CHECK(given.body.modes == silent.body.modes);
  CHECK(given.time.min_sample_rate == silent.time.min_sample_rate);
  CHECK(given.time.periodicity == silent.time.periodicity);
  Scene whole = paper_scene(0);
  choose_by_default(whole, only({"strips", "element_mm", "modes", "min_sample_rate_kHz", "periodicity"}));
  CHECK(whole.time.accepted_error == 0);
  Scene linear = paper_scene(0);
  linear.body.element_order = 1;
  linear.fidelity.integrator = Integrator::newmark;
  choose_by_default(linear, only({}));
  CHECK(linear.body.element_modules == 0);
  CHECK(linear.time.min_sample_rate == Scene().time.min_sample_rate);
  CHECK(linear.body.modes == silent.body.modes);
  for (const SettingError& one : discretisation_plan(linear, only({})).settings)
    CHECK(one.known == (one.key != "element_mm" && one.key != "min_sample_rate_kHz"));
}

TEST_CASE("an accepted error: points of a face in slices, no strips; refusals where no bound is known") {
  Scene scene = paper_scene(0.005);
  scene.fidelity.width = WidthModel::slices;
  choose_discretisation(scene, only({}));
  CHECK((scene.contact.face_points == 0 || scene.contact.face_points > kFacePoints));
  CHECK(scene.contact.strips == Scene().contact.strips);
  const auto refused = [](auto change) {
    Scene other = paper_scene(0.01);
    change(other);
    return message_of([&] { choose_discretisation(other, only({})); });
  };
  CHECK(names(refused([](Scene& s) { s.body.element_order = 1; }), {"element_order", 1, "rms_percent"}));
  CHECK(names(refused([](Scene& s) { s.fidelity.integrator = Integrator::newmark; }), {"newmark"}));
  CHECK(names(refused([](Scene& s) { s.body.near_field = NearField::matching; }), {"matching"}));
}

TEST_CASE(
    "the natural frequency that settings are chosen for: that of P2000 within 6 %, as the root of the inertias") {
  Scene scene = paper_scene(0);
  CHECK(expected_natural_frequency(scene) == relative(2950, 0.06));
  const double before = expected_natural_frequency(scene);
  for (SceneGear& gear : scene.gears) gear.total_inertia *= 4;
  CHECK(expected_natural_frequency(scene) == relative(before / 2, 1e-12));
}
