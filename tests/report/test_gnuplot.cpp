#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <tuple>

#include "base/error.h"
#include "figure_block.h"
#include "gear/pair.h"
#include "gear/train.h"
#include "own_folder.h"
#include "paper/beside.h"
#include "paper/table1.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "report/response_figures.h"
#include "report/wireframe.h"
#include "signal/spectrum.h"
#include "system/rectangular_wave.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;

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
StaticResult some_static(double torque) {
  StaticResult s;
  s.gear[0].design = s.gear[1].design = standard_gear();
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
  set_harmonics(s);
  s.rectangular_wave = rectangular_wave(s);
  return s;
}

ResponseResult some_response(Direction direction) {
  ResponseResult r;
  r.torque = 150;
  r.direction = direction;
  r.natural_frequency = 2900;
  const int n = 5;
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(n, 2000, 2400);
  if (direction == Direction::down) r.mesh_frequency.reverseInPlace();
  r.dte_rms = Eigen::VectorXd::LinSpaced(n, 1e-6, 5e-6);
  r.dte_mean = r.tooth_load_max = r.mesh_force_max = Eigen::VectorXd::Ones(n);
  r.separation_fraction = r.separations_per_period = Eigen::VectorXd::Zero(n);
  r.period_multiple = Eigen::VectorXi::Ones(n);
  r.jump_frequency = Eigen::VectorXd::Constant(1, 2250.0);
  r.jump_width = Eigen::VectorXd::Constant(1, 1.0);
  return r;
}

// A ring of 6 "teeth", 2 x 2 four-node or nine-node elements a sector, radii 1 to 2 m.
SectorGrid ring(int order) {
  const int teeth = 6, across = 2 * order + 1;
  SectorGrid m;
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

TEST_CASE("which figure of P2000 a figure is beside, by its name") {
  CHECK(paper_figure("fig07") == "Figure 7");
  CHECK(paper_figure("fig07-600") == "Figure 7");
  CHECK(paper_figure("fig12") == "Figure 12");
  CHECK(paper_figure("fig14-elastic") == "Figures 14 and 16");
  for (const char* name : {"waterfall", "fig", "figure", "fig1", "fig071", "figs07"})
    CHECK(paper_figure(name).empty());
}

TEST_CASE(
    "rectangular wave: switches at the ends of the path of contact, levels in the middle of the zones") {
  const StaticResult s = some_static(100);
  const RectangularWave& wave = s.rectangular_wave;
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

TEST_CASE("templates: above a picture stand its title and its scene, in two lines; notes stand below") {
  int templates = 0;
  for (const auto& entry : std::filesystem::directory_iterator("pipelines/plots")) {
    std::ifstream file(entry.path());
    std::string line;
    while (std::getline(file, line)) {
      INFO(entry.path() << ": " << line);
      // What stands for the title of a picture: `heading` is title and scene, `title` the title alone.
      const size_t at = line.find(" title heading"), plain = line.find("multiplot title title");
      if (at == std::string::npos && plain == std::string::npos) continue;
      ++templates;
      CHECK(!contains(line, "note2"));
      if (at != std::string::npos) CHECK(line.find("\\n", at) == std::string::npos);
    }
  }
  CHECK(templates > 3);
}

TEST_CASE(
    "statics figures: torques as the scene lists them, the period closes, units are micrometre and N/µm") {
  const StaticResult low = some_static(100), high = some_static(300);
  const Figure te = transmission_error_figure({high, low});
  const FigureBlock& curve = block(te, "transmission_error");
  REQUIRE(curve.rows.size() == 129);
  CHECK(curve.rows.back()[0] == 1.0);
  CHECK(curve.rows.back()[1] == curve.rows.front()[1]);
  CHECK(curve.rows[0][1] == high.transmission_error[0] * 1e6);
  CHECK(curve.rows[0][2] == low.transmission_error[0] * 1e6);
  CHECK(te.panels[0].curves[0].label == "300 N m");
  CHECK(te.panels[0].curves[1].label == "100 N m");
  CHECK(block(te, "transmission_error harmonics").rows.size() == 10);

  const Figure k = mesh_stiffness_figure({low, high});
  CHECK(block(k, "mesh_stiffness").rows[3][1] == low.stiffness_secant[3] * 1e-6);
  CHECK(block(k, "mesh_stiffness").columns[1].ends_with("[N/µm]"));
  CHECK(block(k, "rectangular wave").rows.size() == 6);
  CHECK(block(k, "rectangular wave harmonics").rows[0][1] == low.rectangular_wave.amplitude(1) * 1e-6);
  // The wave is that of the torque that the scene lists first, whether or not it is the lowest.
  const Figure falling = mesh_stiffness_figure({high, low});
  CHECK(block(falling, "rectangular wave harmonics").rows[0][1] == high.rectangular_wave.amplitude(1) * 1e-6);
  CHECK(block(falling, "mesh_stiffness").rows[3][1] == block(k, "mesh_stiffness").rows[3][2]);
  CHECK(block(falling, "mesh_stiffness").rows[3][2] == block(k, "mesh_stiffness").rows[3][1]);
}

TEST_CASE(
    "statics figures: no input, a torque twice, different phases, more curves than colours are rejected") {
  CHECK(failure_of([] { transmission_error_figure({}); }) == Failure::input);
  CHECK(failure_of([] { mesh_stiffness_figure({some_static(100), some_static(100)}); }) == Failure::input);
  CHECK(failure_of([] {
          StaticResult other = some_static(200);
          other.mesh_phase[5] += 1e-3;
          transmission_error_figure({some_static(100), other});
        }) == Failure::input);
  CHECK(failure_of([] {
          std::vector<StaticResult> many;
          for (int i = 1; i <= 7; ++i) many.push_back(some_static(100 * i));
          transmission_error_figure(many);
        }) == Failure::input);
}

TEST_CASE(
    "response figure: order of the inputs does not matter, the pen lifts at a jump, the arrow follows the sweep") {
  const ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
  const Figure figure = response_figure({down, up});
  CHECK(plot_data(figure) == plot_data(response_figure({up, down})));
  const auto& rows = block(figure, "a 150 N m up").rows;
  REQUIRE(rows.size() == 6);
  CHECK(rows[2][0] == 2200);
  CHECK(rows[3].empty());  // between 2200 and 2300 Hz
  CHECK(rows[4][0] == 2300);
  CHECK(rows[4][1] == relative(4.0, 1e-14));
  const auto& jump = block(figure, "a 150 N m jumps down").rows.at(0);
  CHECK(jump[0] == 2250);
  CHECK(jump[1] == relative(2.0, 1e-14));  // falling: 2300 Hz first
  CHECK(jump[2] == relative(3.0, 1e-14));
}

TEST_CASE(
    "response figure: two of one direction, other torques, other choices, a jump outside the sweep are rejected") {
  const auto rejected = [](auto change) {
    ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
    change(up, down);
    return failure_of([&] { response_figure({up, down}); }) == Failure::input;
  };
  using R = ResponseResult;
  CHECK_FALSE(rejected([](R&, R&) {}));
  CHECK(rejected([](R&, R& down) { down.direction = Direction::up; }));
  CHECK(rejected([](R& up, R&) { up.torque = 200; }));
  CHECK(rejected([](R& up, R&) { up.damping.rayleigh_stiffness = 1e-6; }));
  CHECK(rejected([](R& up, R&) { up.mesh.corner.enabled = false; }));
  CHECK(rejected([](R& up, R&) { up.jump_frequency[0] = 5000; }));
}

TEST_CASE("a curve breaks at a sudden change of the RMS, but not over steps that cross a resonance") {
  ResponseResult r = some_response(Direction::up);
  r.jump_frequency.resize(0);
  r.jump_width.resize(0);
  r.dte_rms = Eigen::VectorXd::Constant(5, 1e-6);
  r.dte_rms.bottomRows(3).setConstant(2e-6);
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(5, 2000, 2100);
  const std::vector<bool> at_change{false, true, false, false, false};
  CHECK(broken_after(r) == at_change);
  // What both directions find on either side is of one branch, but for a jump that one of them has recorded.
  ResponseResult down = some_response(Direction::down);
  down.jump_frequency.resize(0);
  down.jump_width.resize(0);
  down.mesh_frequency = r.mesh_frequency.reverse();
  down.dte_rms = 1.01 * r.dte_rms.colwise().reverse();
  CHECK(broken_after(r, &down) == std::vector<bool>(5, false));
  down.dte_rms(3, 0) *= 1.5;  // at 2025 Hz, before the change
  CHECK(broken_after(r, &down) == at_change);
  down.dte_rms = r.dte_rms.colwise().reverse();
  r.jump_frequency = r.jump_width = Eigen::VectorXd::Constant(1, 2037.5);
  CHECK(broken_after(r, &down) == at_change);
  r.jump_frequency.resize(0);
  r.jump_width.resize(0);
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(5, 400, 800);
  CHECK(broken_after(r) == std::vector<bool>(5, false));
}

TEST_CASE(
    "response figure: a panel for each set of choices, a curve for each torque, numbers as in the artifacts") {
  std::vector<ResponseResult> sweeps;
  for (double eta : {7.7e-6, 4e-6})
    for (double torque : {300.0, 100.0})
      for (const Direction direction : {Direction::up, Direction::down}) {
        sweeps.push_back(some_response(direction));
        sweeps.back().torque = torque;
        sweeps.back().damping.rayleigh_stiffness = eta;
        sweeps.back().dte_mean *= torque * eta;
      }
  const Figure figure = response_figure(sweeps);
  CHECK(figure.title == "Dynamic transmission error (DTE) against mesh frequency, 300, 100 N m");
  CHECK(figure.notes[1].find("(a) 300, 100 N m; Rayleigh damping η = 7.7 µs") == 0);
  CHECK(figure.notes[2].find("(a) 300 N m: jumps rising 2250, falling 2250 Hz; 100 N m: ") == 0);
  CHECK(figure.notes[3].find("(b) 300, 100 N m; Rayleigh damping η = 4 µs") == 0);
  const auto& row = block(figure, "b 100 N m down").rows[0];
  CHECK(row[0] == 2400);
  CHECK(row[1] == relative(1.0, 1e-14));
  CHECK(row[2] == relative(100 * 4e-6 * 1e6, 1e-14));
  const std::string jumps = " N m: jumps rising 2250, falling 2250 Hz";
  REQUIRE(figure.panels.size() == 2);
  CHECK(has_label(figure.panels[1], "300" + jumps));
  CHECK(has_label(figure.panels[1], "100" + jumps));
  // Beside an axis in rpm its keys are in rpm, what stands alone in both.
  Figure turned = figure;
  turned.captions.emplace_back("at 2250.5 Hz, rising 10, 20 and 3 more, falling 30 to 40 Hz");
  apply({"rpm:driver"}, turned);
  const double scale = 60.0 / sweeps[0].gear[0].design.teeth;
  const auto rpm = [&](double frequency) { return fixed(frequency * scale, 0); };
  CHECK(
      has_label(turned.panels[0], "300 N m: jumps rising " + rpm(2250) + ", falling " + rpm(2250) + " rpm"));
  CHECK(turned.captions.back() == "at " + rpm(2250.5) + " rpm (2250.5 Hz), rising " + rpm(10) + ", " +
                                      rpm(20) + " and 3 more, falling " + rpm(30) + " to " + rpm(40) +
                                      " rpm");
  sweeps.pop_back();
  CHECK(failure_of([&] { response_figure(sweeps); }) == Failure::input);
  sweeps.push_back(sweeps[2]);
  CHECK(failure_of([&] { response_figure(sweeps); }) == Failure::input);
  CHECK(failure_of([] { response_figure({}); }) == Failure::input);
}

TEST_CASE("response figure: a curve breaks where it changes branch without a jump, not on a steep slope") {
  const auto rows_of = [](const Eigen::VectorXd& rms) {
    ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
    up.jump_frequency.resize(0);
    up.jump_width.resize(0);
    up.dte_rms = rms;
    return block(response_figure({up, down}), "a 150 N m up").rows;
  };
  Eigen::VectorXd rms(5);
  rms << 40e-6, 50e-6, 10e-6, 12e-6, 14e-6;
  REQUIRE(rows_of(rms).size() == 6);
  CHECK(rows_of(rms)[2].empty());
  rms << 2e-6, 3.2e-6, 5e-6, 8e-6, 12e-6;
  CHECK(rows_of(rms).size() == 5);
  rms << 2e-6, 2.1e-6, 2.7e-6, 2.8e-6, 2.8e-6;  // a step of 29 %
  CHECK(rows_of(rms).size() == 5);
}

TEST_CASE("response figure: a curve stops where the sweep left its branch, steps before the branch ends") {
  ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
  // falling from 2400 Hz: off the branch after 2300, which ends at 2050 Hz
  down.dte_rms << 5e-6, 6e-6, 1e-6, 1.1e-6, 1.2e-6;
  down.jump_frequency[0] = 2050;
  up.jump_frequency.resize(0);
  up.jump_width.resize(0);
  const Figure figure = response_figure({up, down});
  const auto& rows = block(figure, "a 150 N m down").rows;
  REQUIRE(rows.size() == 6);
  CHECK(rows[1][0] == 2300);
  CHECK(rows[2].empty());
  const auto& jump = block(figure, "a 150 N m jumps down").rows.at(0);
  CHECK(jump[0] == 2050);
  CHECK(jump[1] == relative(6.0, 1e-14));
  CHECK(jump[2] == relative(1.15, 1e-14));  // midway between 2100 and 2000 Hz
  CHECK(jump[6] == 2300);
  CHECK(block(figure, "a 150 N m jumps up").rows.empty());
}

// Sweep at 1000 and 1100 Hz; at 1100 Hz both directions are alike, at 1000 Hz the falling one is `factor` times as large.
// A tooth carries load(its own phase), of period `multiple` in its amplitude.
SweepResult some_sweep(Direction direction, double factor, int multiple = 1) {
  constexpr int n = 64;
  SweepResult s;
  s.gear[0].design = s.gear[1].design = standard_gear();
  s.mesh.centre_distance = 0.15;
  s.torque = 150;
  s.direction = direction;
  s.time.steps_per_period = n;
  s.mesh_frequency = Eigen::Vector2d(1000, 1100);
  if (direction == Direction::down) s.mesh_frequency.reverseInPlace();
  s.period_multiple = Eigen::Vector2i::Constant(multiple);
  s.place_pair(pair_system(s));
  s.transmission_error.assign(2, MatrixRM(n * multiple, 1));
  s.mesh_force = s.transmission_error;
  s.pair = Eigen::Vector3i(-1, 0, 1);
  for (int f = 0; f < 2; ++f) {
    const double size = direction == Direction::down && s.mesh_frequency[f] == 1000 ? factor : 1.0;
    MatrixRM load(n * multiple, 3);
    for (int k = 0; k < n * multiple; ++k) {
      const double phase = static_cast<double>(k) / n;
      s.transmission_error[static_cast<size_t>(f)](k, 0) =
          4e-6 + size * 1e-6 *
                     (std::cos(2 * kPi * phase) + 0.25 * std::sin(4 * kPi * phase) +
                      (multiple > 1 ? 0.5 * std::cos(2 * kPi * phase / multiple) : 0.0));
      for (int j = -1; j <= 1; ++j) {
        const double own = phase - std::floor(phase) + j;
        load(k, j + 1) = std::abs(own) < 0.4 ? size * 1000 * (1 + own) : 0.0;
      }
      s.mesh_force[static_cast<size_t>(f)](k, 0) = load.row(k).sum();
    }
    s.tooth_load.push_back(load);
  }
  return s;
}

TEST_CASE("branches at one speed: two columns where up and down differ, one that says so where they agree") {
  const std::vector<SweepResult> sweeps{some_sweep(Direction::up, 3), some_sweep(Direction::down, 3)};
  const Figure two = vibration_figure(sweeps, 1000);
  REQUIRE(two.panels.size() == 4);
  CHECK(contains(two.panels[0].heading, "upper branch, speed falling"));
  CHECK(contains(two.panels[2].heading, "lower branch, speed rising"));
  const auto& rows = block(two, "a history").rows;
  REQUIRE(rows.size() == 3 * 64 + 1);
  CHECK(rows.back()[0] == relative(3.0, 1e-14));  // ms
  for (int k : {0, 5, 70, 192})
    CHECK(std::abs(rows[k][1] - 3 * (std::cos(2 * kPi * k / 64) + 0.25 * std::sin(4 * kPi * k / 64))) <
          1e-12);
  const auto& lines = block(two, "b spectrum").rows;
  REQUIRE(lines.size() == 10);
  CHECK(lines[0][1] == relative(1.0, 1e-12));
  CHECK(lines[1][0] == 2000);
  CHECK(lines[1][1] == relative(0.25, 1e-12));
  CHECK(std::abs(lines[2][1]) < 1e-12);
  // 1 / (1 + 0.25^2) of the square at the mesh frequency
  CHECK(contains(two.panels[1].heading, "94.1 % of its square at 1 × mesh frequency"));

  const Figure one = vibration_figure(sweeps, 1100);
  CHECK(contains(one.panels[0].heading, "no second branch"));
  CHECK(one.panels.size() == 2);
  CHECK(failure_of([&] { vibration_figure(sweeps, 1050); }) == Failure::input);
  CHECK(failure_of([&] { vibration_figure({sweeps[0]}, 1000); }) == Failure::input);
  CHECK(failure_of([&] { tooth_load_figure({}, 1000); }) == Failure::input);

  // the orbit of a subharmonic is drawn whole, its lines stand between the harmonics
  const Figure sub =
      vibration_figure({some_sweep(Direction::up, 1, 4), some_sweep(Direction::down, 1, 4)}, 1000);
  CHECK(block(sub, "a history").rows.size() == 4 * 64 + 1);
  CHECK(block(sub, "a spectrum").rows[0][0] == 250);
  CHECK(block(sub, "a spectrum").rows[0][1] == relative(0.5, 1e-12));
}

TEST_CASE(
    "tooth loads: every tooth keeps its own load from period to period, loss of contact where no tooth carries") {
  const Figure figure =
      tooth_load_figure({some_sweep(Direction::up, 3), some_sweep(Direction::down, 3)}, 1000);
  for (int t : {-1, 0, 1, 2}) {
    CAPTURE(t);
    const auto& rows = block(figure, text("a tooth i", t < 0 ? "" : "+", t)).rows;
    CHECK(rows.size() > 20);
    for (const auto& row : rows) {
      if (row.empty()) continue;
      const double own = row[0] - t;
      CHECK(std::abs(row[1] - (std::abs(own) < 0.4 ? 3000 * (1 + own) : 0.0)) < 1e-9);
    }
  }
  // none within 0.4 of a pitch point: samples 26 to 38 of 64
  const auto& lost = block(figure, "a contact lost").rows;
  REQUIRE(lost.size() == 3);
  CHECK(lost[1][0] == relative(26.0 / 64, 1e-14));
  CHECK(lost[1][1] == relative(38.0 / 64, 1e-14));
  CHECK(contains(figure.panels[0].heading, "contact lost 1 time a mesh period, for 20.3 % of it"));
}

TEST_CASE("tooth loads of rolling gears pass from period to period without a step") {
  const ReducedBody& body = paper_body();
  const StaticResult statics = static_transmission(body, body, paper_statics(128), 150);
  std::vector<SweepResult> sweeps;
  for (const Direction direction : {Direction::up, Direction::down})
    sweeps.push_back(sweep(body, body, statics, statics.mean_stiffness, paper_sweep(2400, 2400, 20),
                           direction, no_report));
  const Figure figure = tooth_load_figure(sweeps, 2400);
  std::vector<std::vector<double>> rows;
  for (const auto& row : block(figure, "a tooth i+0").rows)
    if (!row.empty()) rows.push_back(row);
  double largest = 0, step = 1e9;
  for (size_t k = 1; k < rows.size(); ++k) {
    largest = std::max(largest, rows[k][1]);
    if (rows[k][0] == 0) step = std::abs(rows[k][1] - rows[k - 1][1]);
  }
  CHECK(rows.front()[0] < -0.8);
  CHECK(rows.back()[0] > 0.8);
  CHECK(largest == relative(sweeps[0].tooth_load[0].maxCoeff(), 1e-14));
  CHECK(step < 0.02 * largest);
}

TEST_CASE(
    "contact zone: complementary, the force of the static stage, points of the flanks, Hertz's pressure") {
  const ReducedBody& body = paper_body();
  StaticResult statics = static_transmission(body, body, paper_statics(8), 150);
  SectorGrid mesh = make_sector_mesh(body.design, body.discretisation);
  CHECK(failure_of([&] { contact_zone_figure(mesh, mesh, statics); }) == Failure::input);
  const ReferenceContact& zone = statics.reference_contact = reference_contact(body, body, statics);
  CHECK(zone.force.sum() == relative(statics.tooth_load(0, 1), 1e-9));
  CHECK(zone.approach == relative(statics.transmission_error[0], 1e-9));
  CHECK(zone.force.minCoeff() >= 0);
  for (Eigen::Index i = 0; i < zone.gap.size(); ++i) {
    CHECK(zone.separation[i] > -1e-15);
    if (zone.force[i] > 0) CHECK(std::abs(zone.separation[i]) < 1e-14);
  }
  const Figure figure = contact_zone_figure(mesh, mesh, statics);
  const GearPair pair(statics.gear[0].design, statics.gear[1].design, 0.15);
  const auto& rows = block(figure, "candidate pairs").rows;
  REQUIRE(rows.size() == static_cast<size_t>(zone.gap.size()));
  double force = 0, most = 0;
  for (const auto& row : rows) {
    CHECK(std::abs(row[2] - row[1] - pair.gap_at(pair.contact(0), row[0] * 1e-3).gap * 1e6) < 1e-6);
    force += row[7] * 1e6 * (row[4] - row[3]) * 1e-3 * 25.4e-3;
    most = std::max(most, row[7]);
  }
  CHECK(force == relative(150 / pair.gear(0).base_radius(), 1e-9));
  double hertz = 0;
  for (const auto& row : block(figure, "Hertz").rows) hertz = std::max(hertz, row[1]);
  CHECK(most == relative(hertz, 0.01));
  CHECK(block(figure, "driver inner region").rows.size() > 100);
  mesh.design.bore_radius = 0.03;
  CHECK(failure_of([&] { contact_zone_figure(mesh, mesh, statics); }) == Failure::input);
}

ImpactResult some_impact(double torque) {
  ImpactResult a;
  a.gear[0].design = a.gear[1].design = standard_gear();
  a.mesh.centre_distance = 0.15;
  a.torque = torque;
  a.states.contact_state = {ContactState::one, ContactState::two, ContactState::mean};
  a.states.natural_frequency = Eigen::Vector3d(2500, 3000, 2940) + Eigen::Vector3d::Constant(torque);
  return a;
}

TEST_CASE("table of natural frequencies: both means, deviations from what is published, torques ascend") {
  std::vector<PrintedClaim> printed;
  for (const auto& [torque, contact, frequency] : {std::tuple{100, "one", 2600.0},
                                                   {100, "two", 3000.0},
                                                   {100, "mean", 2900.0},
                                                   {200, "one", 2700.0},
                                                   {200, "two", 3200.0},
                                                   {200, "mean", 3000.0}}) {
    PrintedClaim claim;
    claim.value = "natural-frequency";
    claim.torque = torque;
    claim.contact = contact;
    claim.printed = frequency;
    printed.push_back(claim);
  }
  const Figure table = natural_frequency_table({some_impact(200), some_impact(100)}, printed);
  const auto& rows = table.blocks.at(0).rows;
  REQUIRE(rows.size() == 2);
  REQUIRE(rows[0].size() == 13);
  CHECK(rows[0][0] == 100);
  CHECK(rows[0][1] == 2600);
  CHECK(std::abs(rows[0][3]) < 1e-12);
  CHECK(rows[0][6] == relative(100.0 * (3100.0 / 3000 - 1), 1e-12));
  CHECK(rows[1][7] == 3140);
  const double ratio = GearPair(standard_gear(), standard_gear(), 0.15).contact_ratio();
  CHECK(rows[1][10] == relative(2700 + (ratio - 1) * 500, 1e-12));
  const std::string words = natural_frequency_text(table);
  CHECK(contains(words, "two pairs                   100     3100.0         3000        +3.33\n"));

  CHECK(natural_frequency_table({some_impact(100)}, {}).blocks[0].rows[0].size() == 5);
  CHECK(!contains(natural_frequency_text(natural_frequency_table({some_impact(100)}, {})), "published"));
  CHECK(failure_of([] { natural_frequency_table({}, {}); }) == Failure::input);
  CHECK(failure_of([] {
          natural_frequency_table({some_impact(100), some_impact(100)}, {});
        }) == Failure::input);
  CHECK(failure_of([&] { natural_frequency_table({some_impact(300)}, printed); }) == Failure::input);
  CHECK(failure_of([] {
          ImpactResult a = some_impact(100);
          a.states.contact_state[0] = ContactState::two;
          natural_frequency_table({a}, {});
        }) == Failure::input);
}

TEST_CASE("response figure: scene and measured damping ratio stand at the panel that they belong to") {
  std::vector<ResponseResult> sweeps;
  CaptionSources captions;
  for (double eta : {7.7e-6, 4e-6})
    for (double torque : {100.0, 300.0}) {
      for (const Direction direction : {Direction::up, Direction::down}) {
        sweeps.push_back(some_response(direction));
        sweeps.back().torque = torque;
        sweeps.back().gear[0].design = sweeps.back().gear[1].design = standard_gear();
        sweeps.back().mesh.centre_distance = 0.15;
        sweeps.back().damping.rayleigh_stiffness = eta;
        captions.scenes.push_back(eta > 5e-6 ? "first: a_b" : "second");
      }
      if (eta < 5e-6 && torque > 200) continue;
      ImpactResult impact = some_impact(torque);
      impact.damping.rayleigh_stiffness = eta;
      // fewest pairs first: at 300 N m contact of three pairs occurs, two is what is asked for
      impact.states.contact_state = {ContactState::one, ContactState::two, ContactState::three,
                                     ContactState::mean};
      impact.states.damping_ratio = Eigen::Vector4d(0.01, 9000 * eta + torque * 1e-5, 0.02, 0.03);
      impact.states.mesh_phase = Eigen::Vector3d(0, 0.5, 0.6);
      captions.impacts.push_back(impact);
    }
  const Figure figure = response_figure(sweeps, captions);
  CHECK(
      figure.notes[1].find(
          "(a) first: a_b; 100, 300 N m; damping ratio 1.00, 1.00 % with one pair, 7.03, 7.23 % with two pairs in contact, by ring-down; Rayleigh") ==
      0);
  CHECK(
      figure.notes[3].find(
          "(b) second; 100, 300 N m; damping ratio 1.00 % with one pair, 3.70 % at 100 N m with two pairs in contact, by ring-down; Rayleigh") ==
      0);
  CHECK(figure.captions.at(1) == "{/:Bold (a)} first: a\\_b");
  CHECK(figure.panels.at(0).heading.starts_with("100, 300 N m;"));
  captions.impacts[0].mesh.corner.enabled = !captions.impacts[0].mesh.corner.enabled;
  CHECK(contains(response_figure(sweeps, captions).notes[1], "with one pair, 7.23 % at 300 N m with"));
}

TEST_CASE("response figure: a lumped model is not described as elastic gears") {
  ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
  up.model = down.model = MotionModel::secant;
  up.separation_fraction(1, 0) = up.separation_fraction(2, 0) = down.separation_fraction(0, 0) = 0.1;
  LumpedParameters lumped;
  lumped.mass = 1.4;
  lumped.damping_ratio = 0.08;
  lumped.damper_acts = DamperActs::always;
  CaptionSources captions;
  captions.lumped = {lumped, lumped};
  const Figure figure = response_figure({up, down}, captions);
  CHECK(figure.notes[0] == "f_n: natural frequency of the mass on the mean stiffness");
  CHECK(
      figure.notes[1].find(
          "(a) 150 N m; mass 1.4 kg, damping ratio 8 %, damper always on; one degree of freedom (Eq. 23), mesh stiffness: secant") ==
      0);
  CHECK(figure.notes.at(2).ends_with(
      "; contact lost at 150 N m: rising 2100 to 2200, falling 2400 or more Hz"));
  CHECK(!contains(response_figure({up, down}).notes[1], "Rayleigh"));
  captions.lumped[1].damping_ratio = 0.05;
  CHECK(failure_of([&] { response_figure({up, down}, captions); }) == Failure::input);
  CHECK(response_figure({some_response(Direction::up), some_response(Direction::down)})
            .notes.at(2)
            .ends_with("; contact is never lost"));
}

TEST_CASE("response figure: speeds beyond the backlash are marked, and said") {
  ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
  const auto rings = [](const Figure& figure) {
    const auto& curves = figure.panels.at(0).curves;
    return std::count_if(curves.begin(), curves.end(), [](const PanelCurve& c) { return c.where == 8; });
  };
  up.separation_fraction(3, 0) = 0.1;
  up.backlash_left = down.backlash_left = Eigen::VectorXd::Constant(5, 1e-6);
  CHECK(rings(response_figure({up, down})) == 0);
  CHECK(!contains(response_figure({up, down}).notes.at(2), "backlash"));
  up.backlash_left[3] = up.backlash_left[4] = -1e-6;
  const Figure known = response_figure({up, down});
  CHECK(rings(known) == 2);
  CHECK(known.notes.at(2).ends_with(
      "; beyond the backlash, where back flanks would touch, at 150 N m: rising 2300 to 2400 Hz"));
  REQUIRE(block(known, "a 150 N m up").columns.back() == "beyond_backlash [1]");
  std::vector<double> beyond;
  for (const auto& row : block(known, "a 150 N m up").rows)
    if (!row.empty()) beyond.push_back(row.back());
  CHECK(beyond == std::vector<double>{0, 0, 0, 1, 1});
  up.model = down.model = MotionModel::secant;
  CHECK(block(response_figure({up, down}), "a 150 N m up").columns.size() == 7);
}

TEST_CASE("error budget: choices stand apart from the errors and in no sum") {
  ErrorBudgetResult budget;
  budget.torque = 150;
  budget.refinement = {"strips, flank table", Eigen::Vector2d(1e-4, -2e-4), Eigen::Vector2d(3e-4, 1e-4),
                       Eigen::Vector2d(4e-4, 2e-4), MatrixRM::Constant(2, 5, -1e-4)};
  budget.choice = {"matching at 1 mm",
                   Eigen::VectorXd::Constant(1, -7e-3),
                   Eigen::VectorXd::Constant(1, 0.01),
                   {},
                   MatrixRM::Constant(1, 5, 2e-3)};
  const Figure figure = error_budget_figure(budget);
  CHECK(contains(figure.notes[0], "mean stiffness of 0.03 %"));
  REQUIRE(block(figure, "changes").rows.size() == 2);
  REQUIRE(block(figure, "choices").rows.size() == 1);
  CHECK(block(figure, "changes").rows[1][1] == relative(0.02, 1e-14));
  CHECK(block(figure, "choices").rows[0][1] == relative(0.7, 1e-14));
  REQUIRE(block(figure, "changes").columns.back() == "flank_pressure [%]");
  CHECK(block(figure, "changes").rows[1].back() == relative(0.02, 1e-14));
  CHECK(figure.panels[0].x.names == std::vector<std::string>{"strips", "flank table", "matching\nat 1 mm"});
  CHECK(figure.panels[0].y.to == 10);  // %
  budget.choice.peak_to_peak_change[0] = 0.224;
  CHECK(error_budget_figure(budget).panels[0].y.to == 100);  // no bar is cut off
  budget.choice = {"", Eigen::VectorXd(0), Eigen::VectorXd(0), {}, MatrixRM(0, 5)};
  CHECK(block(error_budget_figure(budget), "choices").rows.empty());
  CHECK(error_budget_figure(budget).panels[0].rules.empty());
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

TEST_CASE("mesh figure: at the default discretisation its picture has less than 5 MB") {
  BodyDiscretisation usual;
  usual.element_size = 0.4e-3;
  const SectorGrid mesh = make_sector_mesh(paper_gear(), usual);
  StaticResult statics = some_static(100);
  statics.gear[0].design = statics.gear[1].design = paper_gear();
  const Figure figure = mesh_figure(mesh, mesh, statics);
  const std::string picture = draw(figure, PlotFile(figure).path(), "pipelines/plots/fig01.gp", Picture::svg);
  CHECK(picture.size() < 5'000'000);
  CHECK(picture.size() > 100'000);
}

TEST_CASE("mesh figure: meshes of other gears than the pair's are rejected") {
  const SectorGrid mesh = ring(2);
  CHECK(failure_of([&] { mesh_figure(mesh, mesh, some_static(100)); }) == Failure::input);
}

TEST_CASE(
    "draw: both pictures, the same bytes twice; a wrong or missing template is one error with its reason") {
  const TemporaryFolder folder;
  const std::string table = folder / "t.tsv", good = folder / "good.gp", bad = folder / "bad.gp";
  Figure figure;
  figure.title = "A \"title\" with `marks`, µ and \\";
  figure.blocks = {{"a", {"x [m]", "y [N]"}, {{1, 2}, {3, 4}}}};
  figure.numbers = {{"three", 3.0}};
  std::ofstream(table) << plot_data(figure);
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
  CHECK(names(message_of([&] { draw(figure, table, bad, Picture::svg); }), {"nothing_here"}));
  CHECK(failure_of([&] { draw(figure, table, folder / "none.gp", Picture::svg); }) == Failure::io);
}

TEST_CASE("draw: texts and names of files are data, whatever gnuplot would run in them") {
  const OwnFolder folder;
  const std::string mark = folder / "mark", table = folder / "t.tsv", recipe = folder / "all.gp";
  const std::string command = "touch " + mark;
  Figure figure;
  figure.blocks = {{"a", {"x [m]", "y [N]"}, {{1, 2}, {3, 4}}}};
  std::ofstream(table) << plot_data(figure);
  std::ofstream(recipe)
      << "set multiplot title heading\nset label 1 title at graph 0.5, 0.5\nset xlabel note1\n"
         "set ylabel word_of\nset xtics (word_of 1)\nset datafile separator tab\n"
         "plot tsv index \"[a]\" using 1:2 title note1\nunset multiplot\n";
  for (const std::string& words :
       {"`" + command + "`", "'`" + command + "`'", "\\`" + command + "`", "\"`" + command + "`",
        "a\n`" + command + "`", "a\n!" + command, "a'\nsystem('" + command + "')\n'",
        "'; system('" + command + "'); a = '", "\"; system(\"" + command + "\"); a = \"",
        "\r!" + command + "\r", "@GPVAL_PWD $(" + command + ") #", std::string("''''"), std::string("'"),
        std::string("\\")}) {
    CAPTURE(words);
    figure.title = words;
    figure.scenes = {words};
    figure.notes = {words};
    figure.words = {{"word_of", words}};
    CHECK(contains(draw(figure, table, recipe, Picture::svg), "</svg>"));
    CHECK(!std::filesystem::exists(mark));
  }
  // Relative, as a path given on the command line may be.
  for (const std::string name : {"<touch mark", "-e!touch mark"}) {
    CAPTURE(name);
    std::filesystem::copy_file(recipe, name);
    CHECK(contains(draw(figure, table, name, Picture::svg), "</svg>"));
    std::filesystem::remove(name);
    std::filesystem::copy_file(table, name);
    CHECK(contains(draw(figure, name, recipe, Picture::svg), "</svg>"));
    std::filesystem::remove(name);
    CHECK(!std::filesystem::exists(mark));
  }
}

TEST_CASE("fold curves: jumps beyond all curves and cells on the wrong side of a cusp are counted as such") {
  FoldCurvesResult a;
  a.quantity = FoldQuantity::damping;
  a.torque = 150;
  a.curve = Eigen::Vector3i::Zero();
  a.value = Eigen::Vector3d(4e-6, 5e-6, 6e-6);
  a.damping_ratio = Eigen::Vector3d(0.05, 0.06, 0.07);
  a.fold_frequency = Eigen::Vector3d(2400, 2500, 2600);
  a.fold_multiplier = MatrixRM::Ones(3, 2);
  a.highest = Eigen::Vector3i::Ones();
  a.cusp_value = a.cusp_frequency = Eigen::VectorXd::Constant(1, 2600);
  a.cusp_damping_ratio = Eigen::VectorXd::Constant(1, 0.07);
  a.cusp_curve = Eigen::VectorXi::Zero(1);
  JumpMapResult m;
  static_cast<MotionParameters&>(m) = a;
  m.torque = 150;
  m.damping_ratio = Eigen::Vector3d(0.055, 0.065, 0.08);
  m.two_branches = Eigen::Vector3i(1, 0, 0);
  m.jump_case = Eigen::Vector3i(0, 1, 2);
  m.jump_frequency = Eigen::Vector3d(2450.5, 2560, 2700);  // on the curve: 2450, 2550; no curve at 8 %
  m.jump_width = Eigen::Vector3d::Zero();
  const std::vector<std::string> notes = fold_curve_figure({a}, {m}).notes;
  REQUIRE(notes.size() == 3);
  CHECK(notes[1] == "cells of the jump maps: 2 of 3 on the right side of the cusps; not: 150 N m at 6.50 %");
  CHECK(
      notes[2] ==
      "jumps of the sweeps: 1 of 3 within 1 Hz and their width of a curve, the farthest 10.0 Hz; 1 at a damping ratio without a curve");
  a.cusp_damping_ratio.resize(0);
  a.cusp_value.resize(0);
  CHECK(fold_curve_figure({a}, {m}).notes[1] == "3 cells stand beside curves without a cusp");
}
