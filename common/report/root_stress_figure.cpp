#include "report/root_stress_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/iso6336.h"
#include "gear/iso6336_strength.h"
#include "report/response_figures.h"

namespace whine {
namespace {

constexpr double kMegapascal = 1e-6;  // Pa -> MPa

void require_inputs(const StaticArtifact& s, const std::vector<ResponseArtifact>& sweeps) {
  if (s.root_stress_max.size() == 0)
    fail(Failure::input, "root-stress: static.h5 holds no root stress; a pair with a cracked tooth has none");
  if (sweeps.size() != 2 || sweeps[0].direction == sweeps[1].direction)
    fail(Failure::input, "root-stress: it needs two response.h5 beside static.h5, up and down; ",
         sweeps.size(), " given");
  for (const ResponseArtifact& r : sweeps)
    if (r.torque != s.torque || r.root_stress_max[0].size() == 0 || r.loss_factor.size() == 0)
      fail(Failure::input, "root-stress: a response.h5 of ", r.torque, " N m",
           r.root_stress_max[0].size() == 0 ? " holds no root stress (of a lumped model)" : "",
           "; static.h5 is of ", s.torque, " N m");
}

// While the teeth of gear g pass through the mesh, by the phase of their own pair.
FigureBlock cycle_block(const StaticArtifact& s, int g) {
  FigureBlock block{
      text("cycle ", g + 1), {"pair_phase [1]", "root_stress [MPa]"}, {}, "cycle", s.mesh.gear[g]};
  const MatrixRM& stress = s.root_stress[static_cast<size_t>(g)];
  for (Eigen::Index i = 0; i < s.contact.positions; ++i)  // the first of the hunting periods
    for (Eigen::Index k = 0; k < stress.cols(); ++k)
      block.rows.push_back({s.mesh_phase[i] + s.pair[k], stress(i, k) * kMegapascal});
  std::sort(block.rows.begin(), block.rows.end());
  return block;
}

struct AtRest {
  double mesh_force, tooth_load, contact_ratio;
  Eigen::VectorXd root_stress;
};

FigureBlock speed_block(const ResponseArtifact& r, const AtRest& rest) {
  FigureBlock block{text("speed ", r.direction),
                    {"mesh_frequency [Hz]", "root_stress_driver [MPa]", "root_stress_driven [MPa]",
                     "factor_mesh_force [1]", "factor_tooth_load [1]", "factor_root_stress_driver [1]",
                     "factor_root_stress_driven [1]", "loss_factor [1]"},
                    {},
                    "speed",
                    name_of(r.direction)};
  const std::vector<bool> broken = broken_after(r);
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    const double a = r.root_stress_held[0][i], b = r.root_stress_held[1][i];
    block.rows.push_back({r.mesh_frequency[i], a * kMegapascal, b * kMegapascal,
                          r.mesh_force_held[i] / rest.mesh_force, r.tooth_load_held[i] / rest.tooth_load,
                          a / rest.root_stress[0], b / rest.root_stress[1], r.loss_factor[i]});
    if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
  }
  return block;
}

// K_v of exact gears over mesh frequency; the relief is the smaller one of the two gears' tips. In `resonance` the mesh
// frequency (Hz) at which N = 1.
FigureBlock dynamic_factor_block(const StaticArtifact& s, const ResponseArtifact& r, double& resonance) {
  FigureBlock block{"iso", {"mesh_frequency [Hz]", "K_v [1]"}, {}, "iso", ""};
  const IsoStiffness iso = iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design,
                                              s.gear[1].material, s.torque, s.contact_ratio);
  double inverse_mass = 0;  // kg-1
  for (int g = 0; g < kSides; ++g) {
    const double base = ToothGeometry(s.gear[g].design).base_radius();
    inverse_mass += base * base / r.inertia[g];
  }
  resonance = std::sqrt(iso.mesh * s.face_width() * inverse_mass) / (2 * std::numbers::pi);
  IsoDynamics gears;
  gears.contact_ratio = s.contact_ratio;
  gears.line_load = iso.line_load;
  gears.single_stiffness = iso.single;
  gears.relief = std::min(s.mesh.modification[0].tip.amount, s.mesh.modification[1].tip.amount);
  constexpr int kPoints = 400;
  const double from = r.mesh_frequency.minCoeff(), to = r.mesh_frequency.maxCoeff();
  for (int i = 0; i <= kPoints; ++i) {
    const double f = from + (to - from) * i / kPoints;
    block.rows.push_back({f, iso_6336_dynamic_factor(gears, f / resonance)});
  }
  return block;
}

}  // namespace

Figure root_stress_figure(const StaticArtifact& s, const std::vector<ResponseArtifact>& sweeps) {
  require_inputs(s, sweeps);
  const GearPair pair(s);
  const AtRest rest{s.torque / pair.gear(0).base_radius(), s.tooth_load.maxCoeff(), s.contact_ratio,
                    s.root_stress_max};
  const bool external = !pair.internal();
  Figure figure;
  figure.title = "Root stress, " + torque_words(s.torque);
  figure.height = 1300;
  double iso_stress[kSides] = {0, 0}, resonance = 0, high = 0, factor = 1;
  std::string static_words, iso_words;
  for (int g = 0; g < kSides; ++g) {
    figure.blocks.push_back(cycle_block(s, g));
    static_words +=
        text(g ? "; " : "", s.mesh.gear[g], " ", shown(s.root_stress_max[g] * kMegapascal, 4),
             " MPa at a tangent of ", fixed(s.root_stress_angle[g] * 180 / std::numbers::pi, 0), " deg");
    if (!external) continue;
    iso_stress[g] = iso_6336_root_stress(pair, g, s.torque / pair.gear(0).pitch_radius());
    iso_words += text(g ? "; " : "", s.mesh.gear[g], " ", shown(iso_stress[g] * kMegapascal, 4),
                      " MPa, ratio ", shown(s.root_stress_max[g] / iso_stress[g], 3));
  }
  figure.notes = {
      "largest tension along the root beside the loaded flank, in motion held for 1/64 of a mesh period; at "
      "rest: " +
      static_words};
  if (external)
    figure.notes.push_back("sigma_{F0} of ISO 6336-3, method B, at the outer point of single contact: " +
                           iso_words);
  for (const ResponseArtifact& r : sweeps) {
    figure.blocks.push_back(speed_block(r, rest));
    for (const auto& row : figure.blocks.back().rows)
      if (!row.empty()) {
        high = std::max({high, row[1], row[2]});
        factor = std::max({factor, row[3], row[4], row[5], row[6]});
      }
  }
  if (external) figure.blocks.push_back(dynamic_factor_block(s, sweeps[0], resonance));
  figure.blocks.push_back(
      {"rest",
       {"torque [N m]", "root_stress_driver [MPa]", "root_stress_driven [MPa]", "sigma_F0_driver [MPa]",
        "sigma_F0_driven [MPa]", "sigma_H0 [MPa]", "contact_pressure [MPa]", "loss_factor [1]",
        "loss_factor_rigid [1]"},
       {{s.torque, s.root_stress_max[0] * kMegapascal, s.root_stress_max[1] * kMegapascal,
         iso_stress[0] * kMegapascal, iso_stress[1] * kMegapascal,
         external ? kMegapascal * iso_6336_flank_pressure(pair, {s.gear[0].material, s.gear[1].material},
                                                          s.torque / pair.gear(0).pitch_radius())
                  : 0.0,
         s.contact_pressure.maxCoeff() * kMegapascal, s.loss_factor, loss_factor_of_rigid_teeth(pair)}}});
  figure.words = {{"labels", text("'", s.mesh.gear[0], "' '", s.mesh.gear[1], "'")}};
  figure.numbers = {{"iso", external ? 1.0 : 0.0},
                    {"iso_driver", iso_stress[0] * kMegapascal},
                    {"iso_driven", iso_stress[1] * kMegapascal},
                    {"path_start", pair.path_start() / pair.base_pitch()},
                    {"path_end", pair.path_end() / pair.base_pitch()},
                    {"stress_max", high},
                    {"factor_max", factor},
                    {"frequency_from", sweeps[0].mesh_frequency.minCoeff()},
                    {"frequency_to", sweeps[0].mesh_frequency.maxCoeff()},
                    {"resonance", resonance},
                    {"natural_frequency", sweeps[0].natural_frequency}};
  return figure;
}

}  // namespace whine
