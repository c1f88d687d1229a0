// Figures of what does not vary: one speed, no vibration, a constant stiffness. gnuplot refuses a range without width.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "paper_pair.h"
#include "report/efficiency_figure.h"
#include "report/gnuplot.h"
#include "report/response_figures.h"
#include "report/static_figures.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

// Whether gnuplot draws it with a template of the project.
bool drawn(const Figure& figure, const std::string& recipe) {
  const auto table = std::filesystem::temp_directory_path() / text("whine-flat-", getpid(), ".tsv");
  std::ofstream(table) << plot_data(figure);
  const std::string picture = draw(figure, table, "pipelines/plots/" + recipe + ".gp", Picture::svg);
  std::filesystem::remove(table);
  return picture.find("</svg>") != std::string::npos;
}

StaticArtifact flat_statics() {
  constexpr int kPhases = 16, kHarmonics = 11;
  StaticArtifact s;
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
  return s;
}

ResponseArtifact at_one_speed(Direction direction) {
  ResponseArtifact r;
  r.torque = 150;
  r.direction = direction;
  r.model = "finite elements";
  r.natural_frequency = 2900;
  r.mesh_frequency = VectorXd::Constant(1, 2000);
  r.dte_rms = r.dte_mean = r.tooth_load_max = r.mesh_force_max = VectorXd::Zero(1);
  r.separation_fraction = r.separations_per_period = VectorXd::Zero(1);
  r.period_multiple = Eigen::VectorXi::Ones(1);
  return r;
}

}  // namespace

TEST_CASE("figures: at one speed and without vibration, of a constant stiffness, they are drawn") {
  const std::vector<ResponseArtifact> sweeps{at_one_speed(Direction::up), at_one_speed(Direction::down)};
  CHECK(drawn(response_figure(sweeps), "fig05"));
  CHECK(drawn(transmission_error_figure({flat_statics()}), "fig12"));
  CHECK(drawn(mesh_stiffness_figure({flat_statics()}), "fig13"));
}

TEST_CASE("figures: losses at one speed, the same at rest, are drawn") {
  StaticArtifact s = flat_statics();
  s.mesh.friction.coefficient = s.friction_coefficient = 0.05;
  s.efficiency = 0.995;
  s.loss_factor = 0.1;
  s.friction_loss = s.friction_moment[0] = s.friction_moment[1] = VectorXd::Zero(s.mesh_phase.size());
  std::vector<ResponseArtifact> sweeps{at_one_speed(Direction::up), at_one_speed(Direction::down)};
  for (ResponseArtifact& r : sweeps) {
    r.friction.coefficient = VectorXd::Constant(1, 0.05);
    r.friction.power = VectorXd::Constant(1, 190);
    r.friction.efficiency = VectorXd::Constant(1, 0.995);
    r.loss_factor = VectorXd::Constant(1, 0.1);
  }
  CHECK(drawn(efficiency_figure({s}, sweeps), "efficiency"));
}
