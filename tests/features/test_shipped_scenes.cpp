// The table of other gears on the page of the scenes, beside what the scenes give today; what a headline scene has to hold.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "dynamics/impact.h"
#include "gear/body_inertia.h"
#include "gear/iso6336.h"
#include "gear/pair.h"
#include "io/scene.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "signal/response.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/statics.h"

using namespace whine;

namespace {

// The cells of the row of data/scenes/README.md that begins with `head`.
std::vector<std::string> row(const std::string& head) {
  std::ifstream page("data/scenes/README.md");
  std::string line;
  while (std::getline(page, line)) {
    if (!line.starts_with("| " + head)) continue;
    std::vector<std::string> cells;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(cell);
    return cells;
  }
  FAIL("data/scenes/README.md has no row of ", head);
  return {};
}

// The numbers of a cell; digits: how many stand after the point of the first.
struct Cell {
  std::vector<double> numbers;
  int decimals = 0;
};
Cell cell(const std::string& words) {
  Cell out;
  for (size_t i = 0; i < words.size();) {
    size_t end = i;
    while (end < words.size() && (std::isdigit(static_cast<unsigned char>(words[end])) || words[end] == '.'))
      ++end;
    if (end == i) {
      ++i;
      continue;
    }
    const std::string number = words.substr(i, end - i);
    if (out.numbers.empty())
      out.decimals = !contains(number, ".") ? 0 : static_cast<int>(number.size() - number.find('.') - 1);
    out.numbers.push_back(std::stod(number));
    i = end;
  }
  return out;
}

// To the digits that the page shows.
void check(const std::string& words, size_t which, double value) {
  const Cell shown = cell(words);
  REQUIRE(shown.numbers.size() > which);
  CAPTURE(words);
  CHECK(std::abs(shown.numbers[which] - value) <= 0.51 * std::pow(10.0, -shown.decimals));
}

}  // namespace

TEST_CASE("the page of the scenes shows what fzg-c and nasa28 give at rest and by ring-down" *
          doctest::skip()) {
  const std::pair<const char*, double> columns[] = {{"fzg-c", 200}, {"nasa28", 71.8}};
  for (size_t column = 0; column < 2; ++column) {
    const auto& [name, torque] = columns[column];
    CAPTURE(name);
    const Scene scene = read_scene(text("data/scenes/", name, ".toml"));
    const SceneFile file;
    const auto body = [&](const std::string& gear) {
      const BodyParameters p =
          read_body_parameters(file.path(body_parameters(scene, gear), text(gear, ".toml")));
      return reduce(make_sector_mesh(p.design, p.discretisation), p.material, p.discretisation.modes);
    };
    const ReducedBody driver = body(scene.mesh().gear[0]), driven = body(scene.mesh().gear[1]);
    StaticParameters statics;
    statics.mesh = scene.mesh();
    statics.contact = scene.contact;
    statics.contact.positions = 128;
    const StaticResult s = static_transmission(driver, driven, statics, torque);
    const StaticResult reference =
        static_transmission(driver, driven, statics, scene.operation.torques.front());
    SweepParameters settings;
    for (size_t g = 0; g < kSides; ++g) settings.inertia[g] = scene.gear(scene.mesh().gear[g]).total_inertia;
    settings.damping = scene.damping;
    settings.fidelity = scene.fidelity;
    settings.reference_torque = reference.torque;
    as_drawn(settings, {driver.inertia, driven.inertia});
    const ImpactResult rung =
        impact(driver, driven, s, reference.mean_stiffness, settings, ImpactPlan(), no_report);

    const size_t at = column + 1;
    check(row("contact ratio")[at], 0, s.contact_ratio);
    check(row("mean mesh stiffness per face width")[at], 0,
          s.mean_stiffness / s.gear[0].design.face_width * 1e-9);
    check(row("mean mesh stiffness per face width")[3], column,
          iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design, s.gear[1].material,
                             torque, s.contact_ratio)
                  .mesh *
              1e-9);
    for (size_t state = 0; state < 3; ++state)
      check(row("natural frequency")[at], state,
            rung.states.natural_frequency[static_cast<Eigen::Index>(state)]);
    check(row("peak-to-peak transmission error")[at], 0,
          (s.transmission_error.maxCoeff() - s.transmission_error.minCoeff()) * 1e6);
  }
}

// What the default scene shows may be quoted: its RMS, the load that a tooth sustains for 1/64 of a period, and its largest load.
TEST_CASE(
    "the default scene is resolved: 1024 steps a period leave RMS and loads at 2400 Hz, on both branches") {
  const Scene scene = read_scene("data/scenes/parker2000.toml");
  const SceneGear& gear = scene.gear(scene.mesh().gear[0]);
  const ReducedBody body = reduce(make_sector_mesh(gear.design, scene.body), gear.material, scene.body.modes);
  StaticParameters at_rest;
  at_rest.mesh = scene.mesh();
  at_rest.contact = scene.contact;
  at_rest.contact.positions = 128;
  const StaticResult statics = static_transmission(body, body, at_rest, 150);
  const double stiffness =
      static_transmission(body, body, at_rest, scene.operation.torques.front()).mean_stiffness;
  // At 2400 Hz as sweeps come to it: falling along the upper branch, which alone is there at 2900 Hz; rising on the lower one.
  const auto motion = [&](Direction direction, const TimeDiscretisation& time) {
    SweepParameters settings;
    for (double& inertia : settings.inertia) inertia = gear.total_inertia;
    settings.damping = scene.damping;
    settings.fidelity = scene.fidelity;
    settings.time = time;
    settings.reference_torque = scene.operation.torques.front();
    settings.frequency_from = direction == Direction::up ? 2350 : 2400;
    settings.frequency_to = direction == Direction::up ? 2400 : 2900;
    settings.frequency_step = 50;
    return response(sweep(body, body, statics, stiffness, settings, direction, no_report));
  };
  TimeDiscretisation finer = scene.time;
  finer.steps_per_period = 1024;
  finer.min_sample_rate = 1;
  double rms[2];
  for (const Direction direction : {Direction::up, Direction::down}) {
    CAPTURE(direction);
    const ResponseResult shown = motion(direction, scene.time), fine = motion(direction, finer);
    const Eigen::Index last = shown.mesh_frequency.size() - 1;
    REQUIRE(shown.mesh_frequency[last] == 2400);
    rms[direction == Direction::down] = shown.dte_rms(last, 0);
    CHECK(shown.dte_rms(last, 0) == relative(fine.dte_rms(last, 0), 0.006));
    CHECK(shown.tooth_load_sustained(last, 0) == relative(fine.tooth_load_sustained(last, 0), 0.04));
    CHECK(shown.tooth_load_max(last, 0) == relative(fine.tooth_load_max(last, 0), 0.10));
  }
  CHECK(rms[1] > 1.2 * rms[0]);
}
