// Made-up artifacts of pairs with long names and torques of four digits, and the check that no text of their pictures is cut at an edge
// or lies on other text.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "gear/train.h"
#include "one_mesh.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "picture_text.h"
#include "report/draw_panels.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "report/sweep_panels.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/rectangular_wave.h"

namespace whine::pictures {

using Eigen::Index;
using Eigen::VectorXd;

inline constexpr double kTwoPi = 2 * std::numbers::pi;
inline const std::array<std::string, 2> kLong{"intermediate_shaft_pinion_02", "output_shaft_wheel_stage_002"};
inline constexpr const char* kScene =
    "gearbox_of_the_second_variant.toml: Intermediate and output shaft of the second variant, ground, with tip relief";
inline constexpr std::array kTorques{1250.0, 2500.0, 3750.0, 5000.0, 7500.0, 9999.0};

// What is wrong with the picture that a template makes of a figure, a line each; laid out as the PNG and as the SVG.
inline std::vector<std::string> faults(Figure figure, const std::string& name) {
  if (figure.scenes.empty() && !name.starts_with("compare-")) figure.scenes = {kScene};
  const TemporaryFolder folder;
  const std::string eps = folder / (name + ".eps"), wrapper = folder / (name + ".gp"),
                    recipe = std::filesystem::absolute(template_of(figure, "pipelines/plots", name));
  const int height = figure.panels.empty() ? figure.height : panel_picture(figure).height;
  // A pixel is a point here: the letters of this terminal have then the pixels of those of the PNG.
  std::ofstream(wrapper) << "set terminal epscairo size " << fixed(1600 / 72.0, 6) << "in,"
                         << fixed(height / 72.0, 6)
                         << "in font 'DejaVu Sans,18' fontscale 1 enhanced\nset output '" << eps
                         << "'\nplots = '" << std::filesystem::absolute("pipelines/plots").string()
                         << "'\nload '" << recipe << "'\nset output\nreset\nset terminal svg\nplot 0\n";
  const PlotFile data(figure);
  draw(figure, data.path(), wrapper, Picture::svg);
  std::ifstream file(eps, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {}),
      svg = draw(figure, data.path(), recipe, Picture::svg);
  const std::vector<PictureText> texts = texts_of_postscript(bytes), of_svg = texts_of_svg(svg);
  CHECK(texts.size() > 5);
  std::vector<std::string> out = faults_of(texts, 1600, height);
  for (const std::string& fault : faults_of(of_svg, 1600, height)) out.push_back("SVG: " + fault);
  // What lies wholly beyond the page is not in its PostScript; its SVG, which has the same places within 20 pixels, has it.
  if (const char* kept = std::getenv("WHINE_KEEP_PICTURES")) {
    static std::map<std::string, int> drawn;
    const std::string stem = text(kept, "/", name, "-", ++drawn[name]);
    std::ofstream(stem + ".png", std::ios::binary) << draw(figure, data.path(), recipe, Picture::png);
  }
  return out;
}

inline void check(const Figure& figure, const std::string& name) {
  const std::vector<std::string> found = faults(figure, name);
  std::string lines;
  for (const std::string& line : found) lines += "\n  " + line;
  CHECK_MESSAGE(found.empty(), name, ", ", figure.title, lines);
}

inline void set_gears(GearPairParameters& pair, const std::array<std::string, 2>& names = kLong) {
  pair.gear[0].design = pair.gear[1].design = paper_gear();
  pair.gear[0].material = pair.gear[1].material = paper_steel();
  pair.gear[0].design.tooth_thinning = pair.gear[1].design.tooth_thinning = 30e-6;
  pair.mesh.gear = names;
  pair.mesh.centre_distance = 0.150;
  pair.mesh.corner = {true, 1.25 * std::numbers::pi / 180};
  pair.contact = {17, 128};
}

template <class Motions>
void set_motions(Motions& motion) {
  set_gears(motion);
  motion.time = {64, 250e3, 1e-6};
  motion.damping = {1234.5, 7.65432e-6, 0.4567e-3, 0.00512};
  motion.inertia = {0.0148, 0.0148};
  if constexpr (requires { motion.place_pair(pair_system(motion)); }) motion.place_pair(pair_system(motion));
}

inline StaticResult at_rest(double torque) {
  constexpr int n = 128;
  StaticResult s;
  set_gears(s);
  s.torque = torque;
  s.contact_ratio = 1.7547;
  s.mesh_phase = VectorXd::LinSpaced(n, 0, 1 - 1.0 / n);
  s.stiffness_secant = 450e6 + 80e6 * -(kTwoPi * s.mesh_phase.array()).cos() + torque * 1e4;
  s.transmission_error = torque / 0.0704769 / s.stiffness_secant.array();
  s.unloaded_error = VectorXd::Zero(n);
  s.pair = Eigen::Vector3i(-1, 0, 1);
  s.tooth_load = s.contact_pressure = s.contact_half_width = MatrixRM::Zero(n, 3);
  s.root_stress = {MatrixRM::Zero(n, 3), MatrixRM::Zero(n, 3)};
  for (int i = 0; i < n; ++i)
    for (int p = 0; p < 3; ++p) {
      const double own = s.mesh_phase[i] + s.pair[p],
                   share = std::abs(own) < 0.87 ? 1 - 0.5 * std::abs(own) : 0;
      s.tooth_load(i, p) = share * torque / 0.0704769;
      s.contact_pressure(i, p) = 1e7 * std::sqrt(s.tooth_load(i, p));
      s.root_stress[0](i, p) = s.root_stress[1](i, p) = 1e4 * s.tooth_load(i, p);
    }
  s.root_stress_max = Eigen::Vector2d(1e4, 1e4) * s.tooth_load.maxCoeff();
  s.root_stress_angle = Eigen::Vector2d(0.7, 0.8);
  s.root_stress_phase = Eigen::Vector2d(0.1, -0.1);
  s.loss_factor = 0.11;
  s.friction_coefficient = 0.05;
  s.friction_loss = 0.01 * torque * (1 + (kTwoPi * s.mesh_phase.array()).cos());
  s.friction_moment = {s.friction_loss, -s.friction_loss};
  s.efficiency = 0.9912345;
  set_harmonics(s);
  s.rectangular_wave = rectangular_wave(s);
  return s;
}

// Speeds of four digits; peaks of hundreds of micrometres at f_n and its fractions, contact lost and jumps beside them.
inline ResponseResult response_at(double torque, Direction direction, double eta = 7.65432e-6) {
  constexpr int n = 81;
  ResponseResult r;
  set_motions(r);
  r.damping.rayleigh_stiffness = eta;
  r.torque = torque;
  r.direction = direction;
  r.natural_frequency = 5432.1;
  r.mesh_frequency = VectorXd::LinSpaced(n, 1000, 9000);
  if (direction == Direction::down) r.mesh_frequency.reverseInPlace();
  r.dte_rms.resize(n, 1);
  for (int i = 0; i < n; ++i) {
    double rms = 1e-6;
    for (const double f : {1.0, 0.5, 1 / 3.0})
      rms += f * 1e-8 * torque / (0.02 + std::pow((r.mesh_frequency[i] - f * r.natural_frequency) / 1e3, 2));
    r.dte_rms(i, 0) = rms;
  }
  r.backlash_left = 30e-6 - r.dte_rms.array();  // rings where motions go beyond the backlash
  r.dte_mean = r.dte_rms * 2;
  MatrixRM harmonic(n, 10);
  for (int h = 0; h < 10; ++h) harmonic.col(h) = r.dte_rms * std::pow(0.4, h);
  r.dte_harmonic = of_one_mesh(harmonic);
  r.separation_fraction = (r.dte_rms.array() > 20e-6).cast<double>() * 0.3;
  r.separations_per_period = (r.separation_fraction.array() > 0).cast<double>();
  r.period_multiple = Eigen::VectorXi::Ones(n);
  const VectorXd force = torque / 0.07 * (1 + 1e3 * r.dte_rms.col(0).array());
  r.tooth_load_max = r.mesh_force_max = r.tooth_load_sustained = r.mesh_force_sustained = force;
  r.root_stress_max = force * Eigen::RowVector2d(5e3, 6e3);
  r.root_stress_sustained = r.root_stress_max;
  r.root_stress_angle = r.root_stress_phase = MatrixRM::Constant(n, 2, 0.5);
  r.bearing_force_max = force * Eigen::RowVector2d(1, 1);
  r.bearing_force_rms = 0.1 * r.bearing_force_max;
  r.loss_factor = VectorXd::Constant(n, 0.11);
  r.friction.coefficient = VectorXd::Constant(n, 0.05);
  r.friction.power = force;
  r.friction.efficiency = VectorXd::Constant(n, 0.98765) - 1e-7 * force;
  r.pair_phase = VectorXd::LinSpaced(41, -0.9, 0.9);
  r.flank_roll = MatrixRM(41, 2);
  r.flank_roll.col(0) = r.flank_roll.col(1) = VectorXd::LinSpaced(41, 0.2, 0.5);
  r.flank_pressure = 5e6 * force.cwiseSqrt() * Eigen::RowVectorXd::Ones(41);
  r.edge_load_there = MatrixRM::Zero(n, 41);
  r.flank_pressure_sustained = 5e6 * force.cwiseSqrt();
  r.edge_load = force * Eigen::RowVector2d(0.1, 0.2);
  r.jump_frequency =
      direction == Direction::up ? Eigen::Vector3d(2050, 3050, 5750) : Eigen::Vector3d(1950, 2850, 4950);
  r.jump_width = Eigen::Vector3d::Ones();
  return r;
}

inline ImpactResult ring_down_at(double torque) {
  ImpactResult a;
  set_motions(a);
  a.torque = torque;
  ContactStateDecays& s = a.states;
  s.contact_state = {ContactState::one, ContactState::two, ContactState::mean};
  s.natural_frequency = Eigen::Vector3d(5012.3, 5932.1, 5432.1);
  s.damping_ratio = Eigen::Vector3d(0.06543, 0.07654, 0.07);
  s.undamped_frequency = s.natural_frequency;
  s.mesh_phase = Eigen::Vector2d(0, 0.5);
  a.mesh_phase = s.mesh_phase;
  a.natural_frequency = a.eigen_frequency = s.natural_frequency.head(2);
  a.damping_ratio = a.eigen_damping_ratio = s.damping_ratio.head(2);
  return a;
}

inline SweepResult sweep_at(double torque, Direction direction) {
  constexpr int n = 64, speeds = 33;
  SweepResult s;
  set_motions(s);
  s.torque = torque;
  s.direction = direction;
  s.natural_frequency = 5432.1;
  s.mesh_frequency = VectorXd::LinSpaced(speeds, 1000, 9000);
  if (direction == Direction::down) s.mesh_frequency.reverseInPlace();
  s.period_multiple = Eigen::VectorXi::Ones(speeds);
  s.place_pair(pair_system(s));
  s.transmission_error.assign(speeds, MatrixRM::Zero(n, 1));
  s.mesh_force = s.transmission_error;
  s.pair = Eigen::Vector3i(-1, 0, 1);
  for (int f = 0; f < speeds; ++f) {
    // At one speed the directions differ.
    const double size = (direction == Direction::up ? 1 : 1.5) *
                        (1 + 4e5 / (1e5 + std::pow(s.mesh_frequency[f] - 5432.1, 2)));
    MatrixRM load = MatrixRM::Zero(n, 3);
    for (int k = 0; k < n; ++k) {
      const double phase = static_cast<double>(k) / n;
      s.transmission_error[static_cast<size_t>(f)](k, 0) =
          4e-6 + size * 1e-6 * (std::cos(kTwoPi * phase) + 0.3 * std::cos(2 * kTwoPi * phase));
      for (int j = 0; j < 3; ++j)
        if (const double own = phase + j - 1; std::abs(own) < 0.4)
          load(k, j) = torque / 0.07 * size * (1 + own);
      s.mesh_force[static_cast<size_t>(f)](k, 0) = load.row(k).sum();
    }
    s.tooth_load.push_back(load);
  }
  s.backlash_margin = -3e-6;
  s.backlash_left = backlash_left(s);
  return s;
}

inline std::vector<ResponseResult> both_ways(double torque, double eta = 7.65432e-6) {
  return {response_at(torque, Direction::up, eta), response_at(torque, Direction::down, eta)};
}

inline CaptionSources background_of(const std::vector<ResponseResult>& sweeps) {
  CaptionSources b;
  b.scenes.assign(sweeps.size(), kScene);
  std::set<double> seen;
  for (const ResponseResult& r : sweeps) {
    if (seen.insert(r.torque).second) b.impacts.push_back(ring_down_at(r.torque));
  }
  return b;
}

inline std::vector<ResponseResult> six_torques() {
  std::vector<ResponseResult> all;
  for (const double torque : kTorques)
    for (ResponseResult& r : both_ways(torque)) all.push_back(std::move(r));
  return all;
}

inline std::vector<StaticResult> six_at_rest(size_t count = kTorques.size()) {
  std::vector<StaticResult> all;
  for (size_t i = 0; i < count; ++i) all.push_back(at_rest(kTorques[i]));
  return all;
}

}  // namespace whine::pictures
