// Figures of what does not vary: one speed, no vibration, a constant stiffness. gnuplot refuses a range without width.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>

#include "paper_pair.h"
#include "refusal.h"
#include "report/figure_list.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "report/response_figures.h"
#include "system/rectangular_wave.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

// Whether gnuplot draws it with a template of the project.
bool drawn(const Figure& figure, const std::string& recipe) {
  return contains(
      draw(figure, PlotFile(figure).path(), template_of(figure, "pipelines/plots", recipe), Picture::svg),
      "</svg>");
}

StaticResult flat_statics() {
  constexpr int kPhases = 16, kHarmonics = 11;
  StaticResult s;
  s.gear[0].design = s.gear[1].design = paper_gear();
  s.mesh = paper_statics(32).mesh;
  s.torque = 150;
  s.contact_ratio = 1.7547;
  s.contact.positions = kPhases;
  s.mesh_phase = VectorXd::LinSpaced(kPhases, 0, 1 - 1.0 / kPhases);
  s.stiffness_secant = VectorXd::Constant(kPhases, 450e6);
  s.transmission_error = VectorXd::Zero(kPhases);
  s.stiffness_harmonic = s.transmission_error_harmonic = VectorXd::Zero(kHarmonics);
  s.stiffness_harmonic[0] = s.mean_stiffness = 450e6;
  s.rectangular_wave = rectangular_wave(s);
  return s;
}

ResponseResult at_one_speed(Direction direction) {
  ResponseResult r;
  r.torque = 150;
  r.direction = direction;
  r.natural_frequency = 2900;
  r.mesh_frequency = VectorXd::Constant(1, 2000);
  r.dte_rms = r.dte_mean = r.tooth_load_max = r.mesh_force_max = VectorXd::Zero(1);
  r.separation_fraction = r.separations_per_period = VectorXd::Zero(1);
  r.period_multiple = Eigen::VectorXi::Ones(1);
  return r;
}

}  // namespace

TEST_CASE("figures: at one speed and without vibration, of a constant stiffness, they are drawn") {
  const std::vector<ResponseResult> sweeps{at_one_speed(Direction::up), at_one_speed(Direction::down)};
  CHECK(drawn(response_figure(sweeps), "fig05"));
  CHECK(drawn(transmission_error_figure({flat_statics()}), "fig12"));
  CHECK(drawn(mesh_stiffness_figure({flat_statics()}), "fig13"));
}

namespace {

StaticResult flat_losses() {
  StaticResult s = flat_statics();
  s.mesh.friction.coefficient = s.friction_coefficient = 0.05;
  s.efficiency = 0.995;
  s.loss_factor = 0.1;
  s.friction_loss = s.friction_moment[0] = s.friction_moment[1] = VectorXd::Zero(s.mesh_phase.size());
  return s;
}

std::vector<ResponseResult> losses_at(double mesh_frequency) {
  std::vector<ResponseResult> sweeps{at_one_speed(Direction::up), at_one_speed(Direction::down)};
  for (ResponseResult& r : sweeps) {
    r.mesh_frequency[0] = mesh_frequency;
    r.friction.coefficient = VectorXd::Constant(1, 0.05);
    r.friction.power = VectorXd::Constant(1, 190);
    r.friction.efficiency = VectorXd::Constant(1, 0.995);
    r.loss_factor = VectorXd::Constant(1, 0.1);
  }
  return sweeps;
}

}  // namespace

TEST_CASE("figures: losses at one speed, the same at rest, are drawn") {
  CHECK(drawn(efficiency_figure({flat_losses()}, losses_at(2000)), "efficiency"));
}

TEST_CASE("figures: losses mark the speeds at which the motion goes beyond the backlash") {
  std::vector<ResponseResult> sweeps = losses_at(2000);
  sweeps[0].backlash_left = VectorXd::Constant(1, 20e-6);
  sweeps[1].backlash_left = VectorXd::Constant(1, -1e-6);
  const Figure marked = efficiency_figure({flat_losses()}, sweeps);
  CHECK(marked.blocks[0].columns.back() == "beyond_backlash [1]");
  CHECK(marked.blocks[0].rows[0].back() == 0);
  CHECK(marked.blocks[1].rows[0].back() == 1);
  const auto says = [](const Figure& figure, const std::string& words) {
    return std::any_of(figure.notes.begin(), figure.notes.end(),
                       [&](const std::string& note) { return contains(note, words); });
  };
  CHECK(says(marked, "beyond the backlash"));
  CHECK(says(marked, "at 150 N m: 2000 Hz"));
  CHECK(drawn(marked, "efficiency"));
  sweeps[1].backlash_left[0] = 1e-6;
  CHECK(!says(efficiency_figure({flat_losses()}, sweeps), "beyond the backlash"));
}

TEST_CASE("figures: losses say where Schlenk's formula is beyond its tests") {
  StaticResult s = flat_losses();
  const auto notes = [&](double mesh_frequency) {
    std::string all;
    for (const std::string& note : efficiency_figure({s}, losses_at(mesh_frequency)).notes)
      all += note + "; ";
    return all;
  };
  const auto holds = [](const std::string& all, const std::string& words) { return contains(all, words); };
  CHECK(!holds(notes(2000), "Schlenk"));
  s.mesh.friction.law = FrictionLaw::schlenk;
  // 50 teeth and 75 mm: 1 m/s at 106 Hz, 50 m/s at 5305 Hz; 84 N/mm under 150 N m.
  CHECK(holds(notes(100), "below 1 m/s on the pitch line, a mesh frequency of 106 Hz,"));
  CHECK(!holds(notes(110), "m/s on"));
  CHECK(!holds(notes(5300), "m/s on"));
  CHECK(holds(notes(5310), "above 50 m/s on the pitch line, a mesh frequency of 5305 Hz,"));
  CHECK(holds(notes(2000), "at 150 N m the coefficient is that of 150 N/mm"));
  s.gear[0].design.face_width = 10e-3;
  CHECK(!holds(notes(2000), "N/mm"));
}
