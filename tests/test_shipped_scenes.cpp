// The table of other gears on the page of the scenes, beside what the scenes give today.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "dynamics/impact.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "io/scene.h"
#include "paper_pair.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/compliance_split.h"
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
      out.decimals =
          number.find('.') == std::string::npos ? 0 : static_cast<int>(number.size() - number.find('.') - 1);
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
    const auto body = [&](const std::string& gear) {
      const SceneGear& g = scene.gear(gear);
      return reduce(make_sector_mesh(g.design, scene.body), g.material, scene.body.modes);
    };
    const BodyArtifact driver = body(scene.mesh.gear[0]), driven = body(scene.mesh.gear[1]);
    StaticParameters statics;
    statics.mesh = scene.mesh;
    statics.contact = scene.contact;
    statics.contact.positions = 128;
    const StaticArtifact s = static_transmission(driver, driven, statics, torque);
    const StaticArtifact reference =
        static_transmission(driver, driven, statics, scene.operation.torques.front());
    ImpactParameters settings;
    for (size_t g = 0; g < kSides; ++g) settings.inertia[g] = scene.gear(scene.mesh.gear[g]).total_inertia;
    settings.damping = scene.damping;
    settings.fidelity = scene.fidelity;
    settings.reference_torque = reference.torque;
    as_drawn(settings, {driver.inertia, driven.inertia});
    const ImpactArtifact rung =
        impact(driver, driven, s, reference.mean_stiffness, settings, ImpactPlan(), no_report);

    const size_t at = column + 1;
    check(row("contact ratio")[at], 0, s.contact_ratio);
    check(row("mean mesh stiffness per face width")[at], 0,
          s.mean_stiffness / s.gear[0].design.face_width * 1e-9);
    check(row("mean mesh stiffness per face width")[3], column, compliance_split(s).iso.mesh * 1e-9);
    for (size_t state = 0; state < 3; ++state)
      check(row("natural frequency")[at], state, rung.natural_frequency[static_cast<Eigen::Index>(state)]);
    check(row("peak-to-peak transmission error")[at], 0,
          (s.transmission_error.maxCoeff() - s.transmission_error.minCoeff()) * 1e6);
  }
}
