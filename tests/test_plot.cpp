#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "gear/pair.h"
#include "plot/figures.h"
#include "plot/gnuplot.h"
#include "plot/wireframe.h"
#include "relative.h"
#include "signal/spectrum.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;

Failure failure_of(const auto& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.kind();
  }
  return static_cast<Failure>(0);
}

GearDesign standard_gear() {
  GearDesign g;
  g.teeth = 50;
  g.module = 3e-3;
  g.pressure_angle = 20.0 * kPi / 180.0;
  g.rack_tip_radius = 0.38;
  g.face_width = 25.4e-3;
  g.bore_radius = 40e-3;
  return g;
}

// Two levels with rounded steps; what a static stage would give, near enough for the drawing.
StaticArtifact some_static(double torque) {
  StaticArtifact s;
  s.driver = s.driven = standard_gear();
  s.mesh.centre_distance = 0.15;
  s.torque = torque;
  s.contact_ratio = 1.7547;
  const int n = 128;
  s.mesh_phase.resize(n);
  s.stiffness_secant.resize(n);
  s.transmission_error.resize(n);
  for (int i = 0; i < n; ++i) {
    s.mesh_phase[i] = static_cast<double>(i) / n;
    const double c = -std::cos(2 * kPi * s.mesh_phase[i]);
    s.stiffness_secant[i] = 450e6 + 80e6 * c + torque * 1e4;
    s.transmission_error[i] = torque / 0.0704769 / s.stiffness_secant[i];
  }
  const Harmonics k = harmonics(s.stiffness_secant, 10), x = harmonics(s.transmission_error, 10);
  s.stiffness_harmonic.resize(11);
  s.stiffness_harmonic << k.mean, k.amplitude;
  s.transmission_error_harmonic.resize(11);
  s.transmission_error_harmonic << x.mean, x.amplitude;
  s.mean_stiffness = k.mean;
  return s;
}

ResponseArtifact some_response(const std::string& direction) {
  ResponseArtifact r;
  r.torque = 150;
  r.direction = direction;
  r.model = "finite elements";
  r.natural_frequency = 2900;
  const int n = 5;
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(n, 2000, 2400);
  if (direction == "down") r.mesh_frequency.reverseInPlace();
  r.dte_rms = Eigen::VectorXd::LinSpaced(n, 1e-6, 5e-6);
  r.dte_mean = r.tooth_load_max = r.mesh_force_max = Eigen::VectorXd::Ones(n);
  r.separation_fraction = r.separations_per_period = Eigen::VectorXd::Zero(n);
  r.period_multiple = Eigen::VectorXi::Ones(n);
  r.jump_frequency = Eigen::VectorXd::Constant(1, 2250.0);
  r.jump_width = Eigen::VectorXd::Constant(1, 1.0);
  return r;
}

const FigureBlock& block(const Figure& figure, const std::string& name) {
  for (const auto& b : figure.blocks)
    if (b.name == name) return b;
  FAIL("no block " << name);
  return figure.blocks.front();
}

// A ring of 6 "teeth", 2 x 2 four-node or nine-node elements a sector, radii 1 to 2 m.
MeshArtifact ring(int order) {
  const int teeth = 6, across = 2 * order + 1;
  MeshArtifact m;
  m.design.teeth = teeth;
  m.design.bore_radius = 1.0;
  m.discretisation.element_order = order;
  const auto node = [&](int i, int j) {
    return i * across + j;
  };  // i: radius, j: angle, clockwise side first
  m.node_position.resize(across * across, 2);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      const double r = 1.0 + static_cast<double>(i) / (across - 1);
      const double a = kPi / 2 - kPi / teeth + 2 * kPi / teeth * j / (across - 1);
      m.node_position.row(node(i, j)) << r * std::cos(a), r * std::sin(a);
    }
  m.element_node.resize(4, order == 1 ? 4 : 9);
  for (int e = 0; e < 4; ++e) {
    const int i = e / 2 * order, j = e % 2 * order, o = order;
    m.element_node.row(e).head(4) << node(i, j), node(i + o, j), node(i + o, j + o), node(i, j + o);
    if (order == 2)
      m.element_node.row(e).tail(5) << node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 2), node(i, j + 1),
          node(i + 1, j + 1);
  }
  m.bore_node.resize(across);
  m.side_node.resize(across, 2);
  for (int k = 0; k < across; ++k) {
    m.bore_node[k] = node(0, k);
    m.side_node.row(k) << node(k, 0), node(k, across - 1);
  }
  return m;
}

long segments(const Strokes& strokes) {
  long count = 0;
  for (size_t i = 1; i < strokes.size(); ++i) count += !strokes[i].empty() && !strokes[i - 1].empty();
  return count;
}

}  // namespace

TEST_CASE(
    "rectangular wave: switches at the ends of the path of contact, levels in the middle of the zones") {
  const StaticArtifact s = some_static(100);
  const RectangularWave wave = rectangular_wave(s);
  // equal gears: contact ratio 1.7547, both zones centred on the pitch point and half a period from it
  CHECK(wave.high_end - wave.high_begin == relative(0.7547, 1e-4));
  CHECK(0.5 * (wave.high_begin + wave.high_end) == relative(0.5, 1e-12));
  CHECK(wave.low == relative(s.stiffness_secant[0], 1e-12));
  CHECK(wave.high == relative(s.stiffness_secant[64], 1e-12));
  CHECK(wave.at(0.0) == wave.low);
  CHECK(wave.at(0.99) == wave.low);
  CHECK(wave.at(0.5) == wave.high);
  CHECK(wave.at(-0.5) == wave.high);
}

TEST_CASE("rectangular wave: its spectrum is that of its samples, and Parseval holds") {
  const RectangularWave wave{345e6, 508e6, 0.1226, 0.8774};
  const int n = 1 << 14;
  Eigen::VectorXd k(n);
  for (int i = 0; i < n; ++i) k[i] = wave.at((i + 0.5) / n);
  const Harmonics sampled = harmonics(k, 10);
  // a step between two samples is misplaced by half a sample at most: 2 (high - low) / n per step
  const double tolerance = 4 * (wave.high - wave.low) / n;
  CHECK(std::abs(sampled.mean - wave.mean()) < tolerance);
  for (int h = 1; h <= 10; ++h) CHECK(std::abs(sampled.amplitude[h - 1] - wave.amplitude(h)) < tolerance);
  double power = 0;
  for (int h = 1; h <= 20000; ++h) power += 0.5 * wave.amplitude(h) * wave.amplitude(h);
  const double d = wave.high_end - wave.high_begin, step = wave.high - wave.low;
  // the tail beyond h falls as 1 / (pi^2 h): 1e-4 of the sum is ten times that
  CHECK(power == relative(d * (1 - d) * step * step, 1e-4));
}

TEST_CASE("statics figures: torques ascend, the period closes, units are micrometre and 1e6 N/m") {
  const StaticArtifact low = some_static(100), high = some_static(300);
  const Figure te = transmission_error_figure({high, low});
  const FigureBlock& curve = block(te, "transmission_error");
  REQUIRE(curve.rows.size() == 129);
  CHECK(curve.rows.back()[0] == 1.0);
  CHECK(curve.rows.back()[1] == curve.rows.front()[1]);
  CHECK(curve.rows[0][1] == low.transmission_error[0] * 1e6);
  CHECK(curve.rows[0][2] == high.transmission_error[0] * 1e6);
  CHECK(block(te, "transmission_error harmonics").rows.size() == 10);

  const Figure k = mesh_stiffness_figure({low, high});
  CHECK(block(k, "mesh_stiffness").rows[3][1] == low.stiffness_secant[3] * 1e-6);
  CHECK(block(k, "rectangular wave").rows.size() == 6);
  CHECK(block(k, "rectangular wave harmonics").rows[0][1] == rectangular_wave(low).amplitude(1) * 1e-6);
}

TEST_CASE(
    "statics figures: no input, a torque twice, different phases, more curves than colours are refused") {
  CHECK(failure_of([] { transmission_error_figure({}); }) == Failure::input);
  CHECK(failure_of([] { mesh_stiffness_figure({some_static(100), some_static(100)}); }) == Failure::input);
  CHECK(failure_of([] {
          StaticArtifact other = some_static(200);
          other.mesh_phase[5] += 1e-3;
          transmission_error_figure({some_static(100), other});
        }) == Failure::input);
  CHECK(failure_of([] {
          std::vector<StaticArtifact> many;
          for (int i = 1; i <= 7; ++i) many.push_back(some_static(100 * i));
          transmission_error_figure(many);
        }) == Failure::input);
}

TEST_CASE(
    "response figure: order of the inputs does not matter, the pen lifts at a jump, the arrow follows the "
    "march") {
  const ResponseArtifact up = some_response("up"), down = some_response("down");
  const Figure figure = response_figure(down, up);
  CHECK(tsv(figure, {}) == tsv(response_figure(up, down), {}));
  const auto& rows = block(figure, "up").rows;
  REQUIRE(rows.size() == 6);
  CHECK(rows[2][0] == 2200);
  CHECK(rows[3].empty());  // between 2200 and 2300 Hz
  CHECK(rows[4][0] == 2300);
  CHECK(rows[4][1] == relative(4.0, 1e-14));
  const auto& jump = block(figure, "jumps down").rows.at(0);
  CHECK(jump[0] == 2250);
  CHECK(jump[1] == relative(2.0, 1e-14));  // falling: 2300 Hz first
  CHECK(jump[2] == relative(3.0, 1e-14));
}

TEST_CASE(
    "response figure: two of one direction, other torques, other choices, a jump outside the sweep are "
    "refused") {
  const auto refused = [](auto change) {
    ResponseArtifact up = some_response("up"), down = some_response("down");
    change(up, down);
    return failure_of([&] { response_figure(up, down); }) == Failure::input;
  };
  using R = ResponseArtifact;
  CHECK_FALSE(refused([](R&, R&) {}));
  CHECK(refused([](R&, R& down) { down.direction = "up"; }));
  CHECK(refused([](R& up, R&) { up.torque = 200; }));
  CHECK(refused([](R& up, R&) { up.damping.rayleigh_stiffness = 1e-6; }));
  CHECK(refused([](R& up, R&) { up.mesh.corner.enabled = false; }));
  CHECK(refused([](R& up, R&) { up.jump_frequency[0] = 5000; }));
}

TEST_CASE("error budget: choices stand apart from the errors and in no sum") {
  ErrorBudgetArtifact budget;
  budget.torque = 150;
  budget.refinement = {"strips, flank table", Eigen::Vector2d(1e-4, -2e-4), Eigen::Vector2d(3e-4, 1e-4),
                       MatrixRM::Constant(2, 5, -1e-4)};
  budget.choice = {"matching at 1 mm", Eigen::VectorXd::Constant(1, -7e-3),
                   Eigen::VectorXd::Constant(1, 0.01), MatrixRM::Constant(1, 5, 2e-3)};
  const Figure figure = error_budget_figure(budget);
  CHECK(figure.notes[0].find("mean stiffness 0.3 ‰") != std::string::npos);
  REQUIRE(block(figure, "changes").rows.size() == 2);
  REQUIRE(block(figure, "choices").rows.size() == 1);
  CHECK(block(figure, "changes").rows[1][1] == relative(0.2, 1e-14));
  CHECK(block(figure, "choices").rows[0][1] == relative(7, 1e-14));
  const auto word = [&](const std::string& name) {
    for (const auto& [key, value] : figure.words)
      if (key == name) return value;
    return std::string();
  };
  CHECK(word("labels") == "'strips' 'flank table' ");
  CHECK(word("choice_labels") == "'matching at 1 mm' ");
  budget.choice = {"", Eigen::VectorXd(0), Eigen::VectorXd(0), MatrixRM(0, 5)};
  CHECK(block(error_budget_figure(budget), "choices").rows.empty());
}

TEST_CASE(
    "tsv: blocks stand two empty lines apart under their names; a value that is not finite is refused") {
  Figure figure;
  figure.title = "Title";
  figure.blocks = {{"a", {"x [m]", "y [N]"}, {{1, 2}, {}, {3, 0.1}}}, {"b", {"x [m]"}, {{5}}}};
  CHECK(tsv(figure, {"out/x.h5"}) ==
        "# Title\n# from out/x.h5\n\n\n# [a]\n# x [m]\ty [N]\n1\t2\n\n3\t0.1\n\n\n# [b]\n# x [m]\n5\n");
  figure.blocks[1].rows[0][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(failure_of([&] { tsv(figure, {}); }) == Failure::numerical);
}

TEST_CASE("wireframe: every edge of the ring is drawn once, with or without mid nodes") {
  // 2 x 2 elements a sector, 6 sectors: 3 arcs of 2 edges and 2 radii of 2 edges a sector.
  const Placement at;
  CHECK(segments(Wireframe(ring(1)).whole(at, 1.0)) == 6 * (3 * 2 + 2 * 2));
  CHECK(segments(Wireframe(ring(2)).whole(at, 1.0)) == 6 * (3 * 2 + 2 * 2));
  CHECK(segments(Wireframe(ring(2)).window(at, 1.0, Vec2::Zero(), 10.0)) == 2 * 6 * (3 * 2 + 2 * 2));
  CHECK(segments(Wireframe(ring(1)).window(at, 1.0, Vec2(50, 50), 1.0)) == 0);
}

TEST_CASE("wireframe: the outline is closed, on the outer radius, and moves with its placement") {
  for (int order : {1, 2}) {
    CAPTURE(order);
    const Placement at{0.3, Vec2(5, -7)};
    const Strokes outline = Wireframe(ring(order)).outline(at, 1e3);
    REQUIRE(outline.size() == static_cast<size_t>(6 * 2 * order + 1));
    for (const auto& p : outline) CHECK(std::hypot(p[0] - 5e3, p[1] + 7e3) == relative(2e3, 1e-12));
    CHECK(outline.front()[0] == relative(outline.back()[0], 1e-12));
    CHECK(outline.front()[1] == relative(outline.back()[1], 1e-12));
    CHECK(std::atan2(outline[0][1] + 7e3, outline[0][0] - 5e3) == relative(kPi / 3 + 0.3, 1e-12));
  }
}

TEST_CASE("mesh figure: meshes of other gears than the pair's are refused") {
  const MeshArtifact mesh = ring(2);
  CHECK(failure_of([&] { mesh_figure(mesh, mesh, some_static(100)); }) == Failure::input);
}

TEST_CASE(
    "draw: both pictures, the same bytes twice; a wrong or missing template is one error with its reason") {
  const auto folder = std::filesystem::temp_directory_path() / text("whine-plot-", getpid());
  std::filesystem::create_directories(folder);
  const std::string table = folder / "t.tsv", good = folder / "good.gp", bad = folder / "bad.gp";
  Figure figure;
  figure.title = "A \"title\" with `marks`, µ and \\";
  figure.blocks = {{"a", {"x [m]", "y [N]"}, {{1, 2}, {3, 4}}}};
  figure.numbers = {{"three", 3.0}};
  std::ofstream(table) << tsv(figure, {});
  std::ofstream(good) << "set title title noenhanced\nset datafile separator tab\n"
                         "plot [0:three] tsv index \"[a]\" using 1:2 with lines\n";
  std::ofstream(bad) << "plot nothing_here\n";
  for (Picture picture : {Picture::svg, Picture::png}) {
    const std::string bytes = draw(figure, table, good, picture);
    CHECK(bytes.size() > 1000);
    CHECK(bytes == draw(figure, table, good, picture));
    CHECK(failure_of([&] { draw(figure, table, bad, picture); }) == Failure::numerical);
  }
  CHECK(draw(figure, table, good, Picture::svg).find("A \"title\" with `marks`, µ and \\") !=
        std::string::npos);
  CHECK_THROWS_WITH_AS(draw(figure, table, bad, Picture::svg), doctest::Contains("nothing_here"), Error);
  CHECK(failure_of([&] { draw(figure, table, folder / "none.gp", Picture::svg); }) == Failure::io);
  std::filesystem::remove_all(folder);
}
