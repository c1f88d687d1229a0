#include "report/root_stress_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "base/error.h"
#include "gear/iso6336.h"
#include "gear/iso6336_strength.h"
#include "report/response_figures.h"
#include "system/flank_pressure.h"

namespace whine {
namespace {

constexpr double kMegapascal = 1e-6;  // Pa -> MPa

void require_inputs(const StaticArtifact& s, const std::vector<ResponseArtifact>& sweeps) {
  if (s.root_stress_max.size() != kSides || s.root_stress[0].size() == 0 || s.root_stress[1].size() == 0)
    fail(Failure::input, "root-stress: static.h5 holds no root stress; a pair with a cracked tooth has none");
  if (sweeps.size() != 2 || sweeps[0].direction == sweeps[1].direction)
    fail(Failure::input, "root-stress: it needs two response.h5 beside static.h5, up and down; ",
         sweeps.size(), " given");
  for (const ResponseArtifact& r : sweeps) {
    if (r.torque != s.torque)
      fail(Failure::input, "root-stress: a response.h5 of ", r.torque, " N m; static.h5 is of ", s.torque,
           " N m; give both of one torque");
    for (const auto& [name, values] :
         {std::pair{"root_stress_held of the driver", &r.root_stress_held[0]},
          std::pair{"root_stress_held of the driven gear", &r.root_stress_held[1]},
          std::pair{"mesh_force_held", &r.mesh_force_held}, std::pair{"tooth_load_held", &r.tooth_load_held},
          std::pair{"loss_factor", &r.loss_factor}})
      if (values->size() != r.mesh_frequency.size() || values->size() == 0)
        fail(Failure::input, "root-stress: the response.h5 of the sweep ", r.direction, " holds ",
             values->size(), " values of ", name, " at ", r.mesh_frequency.size(),
             " speeds; one at each is needed, which lumped models do not have");
  }
}

// While the teeth of gear g pass through the mesh, by the phase of their own pair.
FigureBlock cycle_block(const StaticArtifact& s, int g) {
  FigureBlock block{
      text("cycle ", g + 1), {"pair_phase [1]", "root_stress [MPa]"}, {}, "cycle", s.mesh.gear[g]};
  const MatrixRM& stress = s.root_stress[static_cast<size_t>(g)];
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(s.contact.positions, stress.rows());
       ++i)  // the first of the hunting periods
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

// Orbits along a branch, stable or not.
FigureBlock branch_block(const BranchArtifact& b, const StaticArtifact& s, const AtRest& rest) {
  if (b.torque != s.torque)
    fail(Failure::input, "root-stress: a branch.h5 of ", b.torque, " N m; static.h5 is of ", s.torque,
         " N m; give both of one torque");
  if (b.root_stress_held[0].size() == 0 || b.root_stress_held[1].size() == 0)
    fail(Failure::input, "root-stress: branch.h5 holds no root stress; make it anew");
  FigureBlock block{"branch",
                    {"mesh_frequency [Hz]", "root_stress_driver [MPa]", "root_stress_driven [MPa]",
                     "factor_mesh_force [1]", "factor_tooth_load [1]", "factor_root_stress_driver [1]",
                     "factor_root_stress_driven [1]", "stable [1]", "part [1]"},
                    {}};
  for (Eigen::Index i = 0; i < b.mesh_frequency.size(); ++i) {
    if (i > 0 && b.part[i] != b.part[i - 1]) block.rows.emplace_back();
    const double first = b.root_stress_held[0][i], second = b.root_stress_held[1][i];
    block.rows.push_back({b.mesh_frequency[i], first * kMegapascal, second * kMegapascal,
                          b.mesh_force_held[i] / rest.mesh_force, b.tooth_load_held[i] / rest.tooth_load,
                          first / rest.root_stress[0], second / rest.root_stress[1],
                          static_cast<double>(b.stable[i]), static_cast<double>(b.part[i])});
  }
  return block;
}

// What the formulas of the standard say; none where they cannot say it, `missing` says why.
struct IsoValues {
  std::optional<double> root[kSides], pressure, loss;  // Pa, Pa, 1
  bool root_in_range = true;
  std::string missing, why;
};

IsoValues iso_values(const StaticArtifact& s, const GearPair& pair) {
  IsoValues out;
  const double force = s.torque / pair.gear(0).pitch_radius();
  const auto take = [&](std::optional<double>& into, const char* name,
                        const std::function<double()>& formula) {
    try {
      into = formula();
    } catch (const Error& error) {
      if (error.kind() != Failure::input && error.kind() != Failure::numerical) throw;
      if (out.missing.find(name) == std::string::npos)
        out.missing += text(out.missing.empty() ? "" : ", ", name);
      if (out.why.empty()) out.why = error.what();
    }
  };
  if (!pair.internal()) {
    for (int g = 0; g < kSides; ++g)
      take(out.root[g], "sigma_{F0}", [&] {
        out.root_in_range = out.root_in_range && iso_6336_root(pair, g).in_range;
        return iso_6336_root_stress(pair, g, force);
      });
    take(out.pressure, "sigma_{H0}", [&] {
      return iso_6336_flank_pressure(pair, {s.gear[0].material, s.gear[1].material}, force);
    });
  }
  take(out.loss, "loss factor of rigid teeth", [&] { return loss_factor_of_rigid_teeth(pair); });
  return out;
}

// Columns that are not known are left out.
FigureBlock rest_block(const StaticArtifact& s, const IsoValues& iso) {
  FigureBlock block{"rest", {}, {{}}};
  const auto add = [&](const char* column, std::optional<double> value) {
    if (!value) return;
    block.columns.emplace_back(column);
    block.rows[0].push_back(*value);
  };
  const auto megapascal = [](std::optional<double> value) {
    return value ? std::optional<double>(*value * kMegapascal) : value;
  };
  const double pressure = flank_pressure(s).smooth;
  add("torque [N m]", s.torque);
  add("root_stress_driver [MPa]", s.root_stress_max[0] * kMegapascal);
  add("root_stress_driven [MPa]", s.root_stress_max[1] * kMegapascal);
  add("sigma_F0_driver [MPa]", megapascal(iso.root[0]));
  add("sigma_F0_driven [MPa]", megapascal(iso.root[1]));
  add("sigma_H0 [MPa]", megapascal(iso.pressure));
  if (pressure > 0) add("contact_pressure [MPa]", pressure * kMegapascal);
  add("loss_factor [1]", s.loss_factor);
  add("loss_factor_rigid [1]", iso.loss);
  return block;
}

// K_v of exact gears over mesh frequency; the relief is the smaller one of the two gears' tips. In `resonance` the mesh
// frequency (Hz) at which N = 1, in `in_range` whether the stiffness formula is tested for such gears.
FigureBlock dynamic_factor_block(const StaticArtifact& s, const ResponseArtifact& r, double& resonance,
                                 bool& in_range) {
  FigureBlock block{"iso", {"mesh_frequency [Hz]", "K_v [1]"}, {}, "iso", ""};
  const IsoStiffness iso = iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design,
                                              s.gear[1].material, s.torque, s.contact_ratio);
  in_range = iso.in_range;
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

// NOLINTNEXTLINE(readability-function-size): blocks and notes of one figure
Figure root_stress_figure(const StaticArtifact& s, const std::vector<ResponseArtifact>& sweeps,
                          const std::vector<BranchArtifact>& branches) {
  require_inputs(s, sweeps);
  const GearPair pair(s);
  const AtRest rest{s.torque / pair.gear(0).base_radius(), s.tooth_load.maxCoeff(), s.contact_ratio,
                    s.root_stress_max};
  const IsoValues iso = iso_values(s, pair);
  // K_v has formulas for contact ratios above 2, too.
  const bool factors = !pair.internal() && s.contact_ratio >= 1;
  Figure figure;
  figure.title = "Root stress, " + torque_words(s.torque);
  figure.height = 1300;
  double resonance = 0, high = 0, factor = 1;
  std::string static_words, iso_words;
  for (int g = 0; g < kSides; ++g) {
    figure.blocks.push_back(cycle_block(s, g));
    static_words +=
        text(g ? "; " : "", s.mesh.gear[g], " ", shown(s.root_stress_max[g] * kMegapascal, 4),
             " MPa at a tangent of ", fixed(s.root_stress_angle[g] * 180 / std::numbers::pi, 0), " deg");
    if (iso.root[g])
      iso_words +=
          text(iso_words.empty() ? "" : "; ", s.mesh.gear[g], " ", shown(*iso.root[g] * kMegapascal, 4),
               " MPa, ratio ", shown(s.root_stress_max[g] / *iso.root[g], 3));
  }
  figure.notes = {"largest tension along the root beside the loaded flank; at rest: " + static_words,
                  "in motion held for 1/64 of a mesh period; root stress in motion is that of the tooth "
                  "loads as at rest: the "
                  "inertia of the body, kept modes included, adds none"};
  if (!iso_words.empty())
    figure.notes.push_back("sigma_{F0} of ISO 6336-3, method B, at the outer point of single contact: " +
                           iso_words);
  const auto add_motions = [&](FigureBlock block) {
    for (const auto& row : block.rows)
      if (!row.empty()) {
        high = std::max({high, row[1], row[2]});
        factor = std::max({factor, row[3], row[4], row[5], row[6]});
      }
    figure.blocks.push_back(std::move(block));
  };
  for (const ResponseArtifact& r : sweeps) add_motions(speed_block(r, rest));
  if (branches.size() > 1)
    fail(Failure::input, "root-stress: ", branches.size(), " branch.h5 given, one at most");
  for (const BranchArtifact& b : branches) add_motions(branch_block(b, s, rest));
  bool stiffness_in_range = true;
  if (factors) figure.blocks.push_back(dynamic_factor_block(s, sweeps[0], resonance, stiffness_in_range));
  std::string beyond;
  if (!iso.root_in_range) beyond = "Y_S (1 <= q_s < 8)";
  if (!stiffness_in_range)
    beyond += text(beyond.empty() ? "" : " and ",
                   "c' in K_v (-0.5 <= x_1 + x_2 <= 2, contact ratio 1.2 to 1.9; here ",
                   shown(s.contact_ratio, 3), ")");
  if (!beyond.empty())
    figure.notes.push_back("outside of the range that ISO 6336 gives for its formulas: " + beyond);
  if (!iso.missing.empty()) figure.notes.push_back("left out: " + iso.missing + " (" + iso.why + ")");
  figure.blocks.push_back(rest_block(s, iso));
  figure.words = {{"labels", text("'", s.mesh.gear[0], "' '", s.mesh.gear[1], "'")}};
  figure.numbers = {{"iso", factors ? 1.0 : 0.0},
                    {"iso_driver", iso.root[0].value_or(0) * kMegapascal},
                    {"iso_driven", iso.root[1].value_or(0) * kMegapascal},
                    {"path_start", pair.path_start() / pair.base_pitch()},
                    {"path_end", pair.path_end() / pair.base_pitch()},
                    {"stress_max", high},
                    {"factor_max", factor},
                    {"branches", static_cast<double>(branches.size())},
                    {"frequency_from", sweeps[0].mesh_frequency.minCoeff()},
                    {"frequency_to", sweeps[0].mesh_frequency.maxCoeff()},
                    {"resonance", factors ? resonance : 0},
                    {"notes", static_cast<double>(figure.notes.size())},
                    {"natural_frequency", sweeps[0].natural_frequency}};
  return figure;
}

}  // namespace whine
