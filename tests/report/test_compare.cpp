// Designs side by side, and figures in the axes of engineers: speeds in rpm, amplitudes in dB.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "figure_block.h"
#include "gear/system_layout.h"
#include "one_mesh.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/compare.h"
#include "report/compare_figures.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "signal/spectrum.h"
#include "small_system.h"
#include "system/natural_modes.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

ResponseResult some_response(Direction direction, int driven_teeth = 40) {
  ResponseResult r;
  r.gear[0].design = paper_gear(50);
  r.gear[1].design = paper_gear(driven_teeth);
  r.mesh.gear[0] = "pinion_1";
  r.mesh.gear[1] = "wheel";
  r.mesh.centre_distance = 0.15;
  r.torque = 150;
  r.direction = direction;
  r.natural_frequency = 2300;
  const int n = 5;
  r.mesh_frequency = VectorXd::LinSpaced(n, 2000, 2400);
  if (direction == Direction::down) r.mesh_frequency.reverseInPlace();
  r.dte_rms = VectorXd::LinSpaced(n, 1e-6, 5e-6);
  r.dte_mean = r.tooth_load_max = r.mesh_force_max = VectorXd::Ones(n);
  r.dte_harmonic = of_one_mesh(1e-6 * MatrixRM::Ones(n, 3));
  r.dte_harmonic[2](1, 0) = 10e-6;
  r.dte_harmonic[3](2, 0) = 0;
  r.separation_fraction = r.separations_per_period = VectorXd::Zero(n);
  r.period_multiple = Eigen::VectorXi::Ones(n);
  r.jump_frequency = r.jump_width = VectorXd(0);
  return r;
}

std::vector<ResponseResult> both_ways() {
  return {some_response(Direction::up), some_response(Direction::down)};
}

SystemStaticResult pair_at(double torque, double crowning) {
  StaticParameters settings = paper_statics(16);
  settings.mesh.gear[0] = crowning > 0 ? "sun" : "pinion";
  settings.mesh.gear[1] = "wheel";
  settings.mesh.modification[0].crowning = crowning;
  const ReducedBody& body = paper_body(40e-3, 0.8e-3);
  SystemStaticResult rest = pair_at_rest(body, body, settings, torque);
  StaticResult& s = rest.mesh[0];
  const Harmonics h = harmonics(s.transmission_error, 4);
  s.transmission_error_harmonic.resize(5);
  s.transmission_error_harmonic << h.mean, h.amplitude;
  return rest;
}

StaticResult at_rest(double torque, double crowning = 0) {
  return pair_at(torque, crowning).mesh[0];
}

Design design(const std::string& name, const std::vector<double>& torques, double crowning = 0) {
  Design out{name, {}};
  out.content.scene = name + ": some <title>";
  for (const double torque : torques) out.content.statics.push_back(pair_at(torque, crowning));
  return out;
}

// A train at rest whose transmission errors swing by `swing` (m) to either side.
Design train_design(const std::string& name, double swing) {
  constexpr int kPhases = 16;
  SystemStaticResult a = small_system();
  const Index meshes = static_cast<Index>(a.mesh.size()),
              bodies = static_cast<Index>(a.settings.layout.bodies.size());
  a.mesh_phase = VectorXd::LinSpaced(kPhases, 0, 1 - 1.0 / kPhases);
  for (StaticResult& mesh : a.mesh) {
    mesh.transmission_error = 20e-6 + swing * (2 * std::numbers::pi * a.mesh_phase.array()).cos();
    mesh.stiffness_secant = mesh.stiffness_tangent = VectorXd::Constant(kPhases, 5e8);
    mesh.tooth_load = MatrixRM::Constant(kPhases, 3, 1000.0 / 3);
    mesh.contact_pressure = MatrixRM::Constant(kPhases, 3, 1e9);
  }
  a.mesh_force = MatrixRM::Constant(kPhases, meshes, 1000);
  a.mesh_force.col(0).setConstant(1300);
  a.load_share = MatrixRM::Constant(kPhases, meshes, 1.0 / 3);
  a.load_share.leftCols(3) = a.mesh_force.leftCols(3) / 3300;
  a.bearing_force.assign(kPhases, MatrixRM::Constant(bodies, 2, 100));
  a.mesh_stiffness.assign(kPhases, a.mesh_stiffness[0]);
  Design out{name};
  out.content.scene = name + ": a train";
  out.content.statics = {a};
  return out;
}

const Difference& row(const std::vector<Difference>& rows, const std::string& part,
                      const std::string& quantity) {
  for (const Difference& r : rows)
    if (r.part == part && r.quantity == quantity) return r;
  FAIL("no row " << quantity);
  return rows.front();
}

}  // namespace

TEST_CASE(
    "speeds in rpm of a train: Willis, by what is held, with what stands still beside the name of the axis") {
  const System held = [] {
    Scene scene = planetary_train(3);
    scene.drives = {{"ring", System::DriveKind::held}, {"carrier", System::DriveKind::held}};
    return layout_of(scene);
  }();
  const auto turns = [](const System& system, const std::string& name) {
    const TrainSpeeds speeds = train_speeds(system);
    for (size_t b = 0; b < system.bodies.size(); ++b)
      if (system.bodies[b].name == name) return std::abs(speeds.turns[b]);
    FAIL("no body " << name);
    return 0.0;
  };
  // Sun, planet, ring of 27, 36, 99 teeth.
  CHECK(train_speeds(held).at_rest == "carrier");
  CHECK(turns(held, "sun") == relative(1 / 27.0, 1e-15));
  CHECK(turns(held, "ring") == relative(1 / 99.0, 1e-15));
  CHECK(turns(held, "carrier") == 0);
  const System ring = layout_of(planetary_train(3));
  CHECK(train_speeds(ring).at_rest == "ring");
  CHECK(turns(ring, "ring") == 0);
  CHECK(turns(ring, "sun") / turns(ring, "carrier") == relative(1 + 99 / 27.0, 1e-14));
  CHECK(turns(ring, "sun") == relative(1 / 27.0 + 1 / 99.0, 1e-15));
  CHECK(turns(ring, "planet2") == relative(1 / 36.0, 1e-15));  // on its pin
  Scene scene = planetary_train(3);
  scene.drives = {{"sun", System::DriveKind::held}};
  const System sun = layout_of(scene);
  CHECK(turns(sun, "ring") / turns(sun, "carrier") == relative(1 + 27 / 99.0, 1e-14));
  scene.drives.clear();
  CHECK(names(message_of([&] { train_speeds(layout_of(scene)); }), {"carrier"}));

  const SystemStaticResult rest = small_system();
  const Figure hertz =
      system_sweep_figure({small_response(rest, Direction::up), small_response(rest, Direction::down)});
  Figure rpm = hertz;
  apply({"rpm:sun", 1e-6}, rpm);
  CHECK(rpm.panels[0].x.label == "Speed of sun, ring at rest (rpm)");
  const FigureBlock &a = block(hertz, "dte_rms up"), &b = block(rpm, "dte_rms up");
  CHECK(b.columns[0] == "mesh_frequency [rpm of sun, ring at rest]");
  CHECK(b.columns[1].ends_with("[dB re 1 µm RMS]"));
  for (size_t i = 0; i < a.rows.size(); ++i) {
    CHECK(b.rows[i][0] == relative(a.rows[i][0] * 60 * (1 / 27.0 + 1 / 99.0), 1e-14));
    CHECK(b.rows[i][1] == relative(20 * std::log10(a.rows[i][1]), 1e-12));
  }
  CHECK(rpm.panels[0].y.label == "RMS (dB re 1 µm RMS)");
  const auto refused = [&](const std::string& axis) {
    Figure figure = hertz;
    return message_of([&] { apply({axis}, figure); });
  };
  CHECK(
      refused("rpm:driver") ==
      "--axis rpm:driver: there is no gear driver; there are sun, planet1, planet2, planet3, ring, carrier");
  CHECK(names(refused("rpm:ring"), {"stands", "still"}));
  const Figure campbell = campbell_figure(natural_modes(ring));
  Figure turned = campbell;
  apply({"rpm:carrier"}, turned);
  CHECK(block(turned, "crossings").rows[3][2] ==
        relative(block(campbell, "crossings").rows[3][2] * 60 / 99.0, 1e-14));
  CHECK(block(turned, "crossings").rows[3][3] == block(campbell, "crossings").rows[3][3]);
  CHECK(turned.panels[0].x.to == relative(campbell.panels[0].x.to * 60 / 99.0, 1e-14));
  CHECK(turned.panels[0].words[1].x == relative(campbell.panels[0].words[1].x * 60 / 99.0, 1e-14));
}

TEST_CASE(
    "speeds in rpm of a gear: columns, numbers and title, by its teeth; back again by the other scale") {
  const Figure hertz = order_figure(both_ways());
  for (const auto& [axis, teeth] : {std::pair{"rpm:pinion_1", 50.0}, std::pair{"rpm:driver", 50.0},
                                    std::pair{"rpm:wheel", 40.0}, std::pair{"rpm:driven", 40.0}}) {
    Figure rpm = hertz;
    apply({axis}, rpm);
    const FigureBlock &a = block(hertz, "orders up"), &b = block(rpm, "orders up");
    REQUIRE(a.rows.size() == b.rows.size());
    for (size_t i = 0; i < a.rows.size(); ++i) {
      CHECK(b.rows[i][0] == relative(a.rows[i][0] * 60 / teeth, 1e-15));
      CHECK(b.rows[i][1] == a.rows[i][1]);
    }
    CHECK(b.columns[0].starts_with("mesh_frequency [rpm of "));
    CHECK(rpm.panels[0].rules[0].at == relative(2300 * 60 / teeth, 1e-15));
    CHECK(rpm.panels[0].top->label == "Mesh frequency (Hz)");
    CHECK(rpm.panels[0].top_factor == relative(teeth / 60, 1e-15));
  }
  Figure none = hertz;
  apply({}, none);
  CHECK(plot_data(none) == plot_data(hertz));
  Figure marked = hertz;
  apply({"rpm:pinion_1"}, marked);
  CHECK(marked.panels.back().x.label == "Speed of pinion\\_1 (rpm)");
}

TEST_CASE(
    "levels: 20 dB for each factor of ten, in the words of the reference; nothing has a level far below") {
  Figure figure = order_figure(both_ways());
  apply({"", 1e-6}, figure);
  const FigureBlock& orders = block(figure, "orders up");
  // An order of amplitude 1 µm has an RMS of 1 µm / sqrt(2).
  const double half = 10 * std::log10(2.0);
  CHECK(orders.columns[1] == "order_1 [dB re 1 µm RMS]");
  CHECK(orders.rows[0][1] == relative(-half, 1e-12));
  CHECK(orders.rows[2][2] == relative(20 - half, 1e-12));
  CHECK(orders.rows[3][3] == relative(20 - half - 300, 1e-12));
  CHECK(figure.panels[0].y.to == 30);
  CHECK(figure.panels[0].y.from == -10);
  Figure small = order_figure(both_ways());
  apply({"", 2e-9}, small);
  CHECK(small.panels[0].y.label.ends_with("(dB re 2 nm RMS)"));
  CHECK(block(small, "orders up").rows[0][1] == relative(20 * std::log10(500) - half, 1e-12));
  // An RMS stays one: of a motion that is a cosine it has the level of its first order.
  ResponseResult up = some_response(Direction::up), down = some_response(Direction::down);
  for (ResponseResult* r : {&up, &down}) r->dte_rms.setConstant(1e-6 / std::numbers::sqrt2);
  Figure motion = compared_motion_figure({{"a", up}, {"a", down}, {"b", up}, {"b", down}});
  apply({"", 1e-6}, motion);
  CHECK(motion.blocks[0].rows[0][1] == relative(-half, 1e-12));
  CHECK(motion.blocks[0].rows[0][1] == relative(motion.blocks[0].rows[0][2], 1e-12));
}

TEST_CASE("axes that a figure does not have are rejected by what it has") {
  const auto rejected = [](Figure figure, const EngineeringAxes& axes) {
    return failure_of([&] { apply(axes, figure); });
  };
  const Figure figure = order_figure(both_ways());
  CHECK(rejected(figure, {"rpm:carrier", {}}) == Failure::usage);
  CHECK(rejected(figure, {"Hz", {}}) == Failure::usage);
  CHECK(rejected(figure, {"", -1e-6}) == Failure::usage);
  CHECK(rejected(figure, {"", 0}) == Failure::usage);
  CHECK(rejected(Figure(), {"rpm:driver", {}}) == Failure::usage);
  CHECK(rejected(Figure(), {"", 1e-6}) == Failure::usage);
  // Designs of other teeth have no speed of a gear in common.
  const Figure designs = compared_motion_figure({{"a", some_response(Direction::up)},
                                                 {"a", some_response(Direction::down)},
                                                 {"b", some_response(Direction::up, 41)},
                                                 {"b", some_response(Direction::down, 41)}});
  CHECK(rejected(designs, {"rpm:driver", {}}) == Failure::usage);
  // The same teeth under other names: by their role.
  ResponseResult other_up = some_response(Direction::up), other_down = some_response(Direction::down);
  for (ResponseResult* r : {&other_up, &other_down}) r->mesh.gear[0] = "sun";
  Figure named = compared_motion_figure({{"a", some_response(Direction::up)},
                                         {"a", some_response(Direction::down)},
                                         {"b", other_up},
                                         {"b", other_down}});
  CHECK(rejected(named, {"rpm:sun", {}}) == Failure::usage);
  apply({"rpm:driver", {}}, named);
  CHECK(named.panels.back().x.label == "Speed of driver (rpm)");
}

TEST_CASE("names of designs stand in tables as they are, in pictures without marks") {
  const Figure rest =
      compared_rest_figure({rest_curve("deep_root", at_rest(150)), rest_curve("b", at_rest(150))});
  CHECK(rest.notes[0].starts_with("deep_root: "));
  CHECK(rest.captions[0].starts_with("deep\\_root: "));
  CHECK(rest.panels[0].curves[0].label == "deep\\_root");
}

TEST_CASE("templates of order cuts and of designs in motion draw both axes and levels") {
  for (const bool engineers : {false, true}) {
    Figure orders = order_figure(both_ways()),
           motion = compared_motion_figure({{"a", some_response(Direction::up)},
                                            {"a", some_response(Direction::down)},
                                            {"b", some_response(Direction::up)},
                                            {"b", some_response(Direction::down)}}),
           rest = compared_rest_figure({rest_curve("a", at_rest(150)), rest_curve("b", at_rest(150, 8e-6))});
    if (engineers)
      for (Figure* figure : {&orders, &motion}) apply({"rpm:driven", 1e-6}, *figure);
    for (const auto& [figure, name] : {std::pair{&orders, "order-cuts"}, std::pair{&motion, "compare-motion"},
                                       std::pair{&rest, "compare-rest"}}) {
      const PlotFile data(*figure);
      const std::string svg =
          draw(*figure, data.path(), template_of(*figure, "pipelines/plots", name), Picture::svg);
      CHECK(contains(svg, "</svg>"));
      if (figure != &rest) CHECK((contains(svg, "Speed of wheel (rpm)")) == engineers);
    }
  }
}

TEST_CASE("designs: what differs, with its change; gears by their role; keys of the scenes") {
  const Design first = design("first", {100, 150}), second = design("second", {150, 200}, 8e-6);
  const std::vector<Difference> found = differences({first, second});
  const Difference& stiffness = row(found, "150", "mean mesh stiffness");
  const double a = first.content.statics[1].mesh[0].mean_stiffness, b = second.content.pair().mean_stiffness;
  CHECK(std::stod(stiffness.value[0]) == relative(a * 1e-6, 1e-3));
  CHECK(std::stod(stiffness.value[1]) == relative(b * 1e-6, 1e-3));
  CHECK(std::abs(std::stod(stiffness.change.at(0)) - 100 * (b / a - 1)) < 0.15);
  // At torques that both have; nothing of what is the same, though the gears are called otherwise.
  for (const Difference& r : found) {
    CHECK(r.part == "150");
    CHECK(!contains(r.quantity, "sun"));
    CHECK(r.value[0] != r.value[1]);
  }
  const std::vector<Difference> keys = scene_differences({first, second});
  CHECK(row(keys, "", "modification.crowning_um").value[1].starts_with("8"));
  for (const Difference& r : keys) CHECK(!contains(r.quantity, "teeth"));
  CHECK(differences({first, first}).empty());
  // Names of which one begins with the other, as imports make them, and names that are words of the table.
  Design numbered = first, mesh = first;
  for (SystemStaticResult& s : numbered.content.statics)
    s.mesh[0].mesh.gear[0] = "stirnrad", s.mesh[0].mesh.gear[1] = "stirnrad_2";
  for (SystemStaticResult& s : mesh.content.statics)
    s.mesh[0].mesh.gear[0] = "mesh", s.mesh[0].mesh.gear[1] = "driver";
  CHECK(differences({first, numbered}).empty());
  CHECK(differences({numbered, mesh}).empty());
  CHECK(!contains(compare_html({first, second}, {}), "* At this speed"));
  CHECK(scene_differences({first, first}).empty());

  const std::string page = compare_html({first, second}, {{"compare-rest", "\x89PNG IEND"}});
  CHECK(contains(page, "<h1>first / second</h1>"));
  CHECK(page.find("Differences") < page.find("compare-rest"));
  CHECK(!contains(page, "some <title>"));
  CHECK(!contains(page, "<script"));
  CHECK(!contains(compare_tsv({first, second}), "\nmean mesh"));
  CHECK(contains(compare_tsv({first, second}), "150\tmean mesh stiffness\tN/µm\t"));
}

TEST_CASE(
    "trains side by side: quantities of each mesh, at their own torques; a pair stands beside each mesh") {
  const std::string swing = "static transmission error, peak to peak";
  const Design first = train_design("first", 2e-6), second = train_design("second", 3e-6),
               pair = design("pair", {150}, 8e-6);
  const std::vector<Difference> found = differences({first, second});
  for (const std::string mesh : {"sun-planet1", "planet3-ring"}) {
    const Difference& own = row(found, mesh, swing);
    CHECK(std::stod(own.value[0]) == relative(4, 1e-6));
    CHECK(std::stod(own.value[1]) == relative(6, 1e-6));
    CHECK(own.change.at(0) == "+50.0");
    CHECK(own.unit == "µm");
  }
  for (const Difference& r : found) CHECK(!contains(r.quantity, "bearing"));  // the same in both
  CHECK(differences({first, first}).empty());
  CHECK(scene_differences({first, first}).empty());
  const std::vector<Difference> beside = differences({pair, first});
  const VectorXd& te = pair.content.pair().transmission_error;
  CHECK(std::stod(row(beside, "sun-planet2", swing).value[0]) ==
        relative((te.maxCoeff() - te.minCoeff()) * 1e6, 1e-3));
  // 1300 N of one planet of three, 1000 N of the others; a pair shares no load.
  const Difference& sharing = row(beside, "sun-planet", "the same of mean shares, K_γ");
  CHECK(std::stod(sharing.value[1]) == relative(3 * 1300.0 / 3300, 1e-3));
  CHECK(!std::isdigit(static_cast<unsigned char>(sharing.value[0][0])));
  CHECK(contains(compare_html({pair, first}, {}), "mesh or body"));
  CHECK(contains(compare_tsv({first, second}), "part\tquantity"));
  // Of planets the first stands for all.
  const std::vector<RestCurve> curves = rest_curves("first", first.content.statics[0]);
  REQUIRE(curves.size() == 2);
  CHECK(curves[1].mesh == "planet1-ring");
  const Figure figure = compared_rest_figure({rest_curve("pair", at_rest(150)), curves[0], curves[1]});
  CHECK(figure.panels[0].curves.size() == 3);
  CHECK(figure.panels[0].curves[1].label == "first, sun-planet1");
  Design rigid = first;
  rigid.content.statics.clear();
  rigid.content.modes.emplace();
  CHECK(names(message_of([&] { differences({first, rigid}); }), {"first", "rigid"}));
}

TEST_CASE("designs that cannot be compared are rejected") {
  const Design first = design("first", {100}), other = design("other", {200});
  CHECK(failure_of([&] { differences({first}); }) == Failure::input);
  CHECK(failure_of([&] { differences({first, other}); }) == Failure::input);
  CHECK(failure_of([&] { compared_rest_figure({rest_curve("a", at_rest(100))}); }) == Failure::input);
  CHECK(failure_of([&] {
          compared_rest_figure({rest_curve("a", at_rest(100)), rest_curve("b", at_rest(200))});
        }) == Failure::input);
  CHECK(failure_of([&] {
          compared_rest_figure({rest_curve("a", at_rest(100)), rest_curve("a", at_rest(100))});
        }) == Failure::input);
  CHECK(failure_of([&] {
          compared_motion_figure({{"a", some_response(Direction::up)}, {"b", some_response(Direction::up)}});
        }) == Failure::input);
}
