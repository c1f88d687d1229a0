#include "report/figure_list.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/iso_comparison.h"
#include "report/response_figures.h"
#include "signal/no_root_stress.h"

namespace whine {
namespace {

void require_root_stresses(const StaticResult& s, const std::vector<ResponseResult>& sweeps) {
  if (const std::string why = why_no_root_stress(s); !why.empty()) fail(Failure::input, "root-stress: ", why);
  if (sweeps.size() != 2 || sweeps[0].direction == sweeps[1].direction)
    fail(Failure::input, "root-stress: it needs two response.h5 beside static.h5, up and down; ",
         sweeps.size(), " given");
  for (const ResponseResult& r : sweeps) {
    if (r.torque != s.torque)
      fail(Failure::input, "root-stress: a response.h5 of ", r.torque, " N m; static.h5 is of ", s.torque,
           " N m; give both of one torque");
    for (const auto& [name, rows] : {std::pair{"root_stress_sustained", r.root_stress_sustained.rows()},
                                     std::pair{"mesh_force_sustained", r.mesh_force_sustained.rows()},
                                     std::pair{"tooth_load_sustained", r.tooth_load_sustained.rows()},
                                     std::pair{"loss_factor", r.loss_factor.size()}})
      if (rows != r.mesh_frequency.size() || rows == 0)
        fail(Failure::input, "root-stress: the response.h5 of the sweep ", r.direction, " holds ", rows,
             " values of ", name, " at ", r.mesh_frequency.size(),
             " speeds; one at each is needed, which lumped models do not have");
  }
}

// While the teeth of gear g pass through the mesh, by the phase of their own pair.
FigureBlock cycle_block(const StaticResult& s, int g) {
  FigureBlock block{
      text("cycle ", g + 1), {"pair_phase [1]", "root_stress [MPa]"}, {}, "cycle", s.mesh.gear[g]};
  const MatrixRM& stress = s.root_stress[static_cast<size_t>(g)];
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(s.contact.positions, stress.rows());
       ++i)  // the first of the hunting periods
    for (Eigen::Index k = 0; k < stress.cols(); ++k)
      block.rows.push_back({s.mesh_phase[i] + s.pair[k], stress(i, k) * kInMegapascals});
  std::sort(block.rows.begin(), block.rows.end());
  return block;
}

// Where the root stresses stand.
void add_place_columns(const GearPairParameters& pair, FigureBlock& block) {
  for (const auto& gear : pair.mesh.gear) {
    block.columns.push_back("root_angle_" + gear + " [deg]");
    block.columns.push_back("root_phase_" + gear + " [1]");
  }
}

void add_place(double angle, double phase, std::vector<double>& row) {
  row.push_back(angle * 180 / std::numbers::pi);
  row.push_back(phase);
}

struct AtRest {
  double mesh_force, tooth_load, contact_ratio;
  Eigen::VectorXd root_stress;
};

// Of the motions at one torque: speed, stresses and factors.
std::vector<std::string> motion_columns(const GearPairParameters& pair) {
  const auto &driver = pair.mesh.gear[0], &driven = pair.mesh.gear[1];
  return {"mesh_frequency [Hz]",
          "root_stress_" + driver + " [MPa]",
          "root_stress_" + driven + " [MPa]",
          "factor_mesh_force [1]",
          "factor_tooth_load [1]",
          "factor_root_stress_" + driver + " [1]",
          "factor_root_stress_" + driven + " [1]"};
}

FigureBlock stress_block(const ResponseResult& r, const ResponseResult& other, const AtRest& rest) {
  FigureBlock block{text("speed ", r.direction), motion_columns(r), {}, "speed", name_of(r.direction)};
  block.columns.emplace_back("loss_factor [1]");
  add_place_columns(r, block);
  const std::vector<bool> broken = broken_after(r, &other);
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    const double a = r.root_stress_sustained(i, 0), b = r.root_stress_sustained(i, 1);
    block.rows.push_back({r.mesh_frequency[i], a * kInMegapascals, b * kInMegapascals,
                          r.mesh_force_sustained(i, 0) / rest.mesh_force,
                          r.tooth_load_sustained(i, 0) / rest.tooth_load, a / rest.root_stress[0],
                          b / rest.root_stress[1], r.loss_factor[i]});
    for (Eigen::Index g = 0; g < kSides; ++g)
      add_place(r.root_stress_angle(i, g), r.root_stress_phase(i, g), block.rows.back());
    if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
  }
  return block;
}

// Orbits along a branch, stable or not.
FigureBlock branch_block(const BranchResult& b, const StaticResult& s, const AtRest& rest) {
  if (b.torque != s.torque)
    fail(Failure::input, "root-stress: a branch.h5 of ", b.torque, " N m; static.h5 is of ", s.torque,
         " N m; give both of one torque");
  if (b.root_stress_sustained.size() == 0)
    fail(Failure::input, "root-stress: branch.h5 holds no root stress; make it anew");
  FigureBlock block{"branch", motion_columns(b), {}};
  for (const char* column : {"stable [1]", "part [1]"}) block.columns.emplace_back(column);
  add_place_columns(b, block);
  for (Eigen::Index i = 0; i < b.mesh_frequency.size(); ++i) {
    if (i > 0 && b.part[i] != b.part[i - 1]) block.rows.emplace_back();
    const double first = b.root_stress_sustained(i, 0), second = b.root_stress_sustained(i, 1);
    block.rows.push_back({b.mesh_frequency[i], first * kInMegapascals, second * kInMegapascals,
                          b.mesh_force_sustained(i, 0) / rest.mesh_force,
                          b.tooth_load_sustained(i, 0) / rest.tooth_load, first / rest.root_stress[0],
                          second / rest.root_stress[1], static_cast<double>(b.stable[i]),
                          static_cast<double>(b.part[i])});
    for (Eigen::Index g = 0; g < kSides; ++g)
      add_place(b.root_stress_angle(i, g), b.root_stress_phase(i, g), block.rows.back());
  }
  return block;
}

// Columns that are not known are left out.
FigureBlock rest_block(const StaticResult& s, const IsoComparison& iso) {
  FigureBlock block{"rest", {}, {{}}};
  const auto add = [&](const std::string& column, std::optional<double> value) {
    if (!value) return;
    block.columns.emplace_back(column);
    block.rows[0].push_back(*value);
  };
  const auto megapascal = [](std::optional<double> value) {
    return value ? std::optional<double>(*value * kInMegapascals) : value;
  };
  const double pressure = s.flank_pressure.smooth;
  add("torque [N m]", s.torque);
  for (int g = 0; g < kSides; ++g)
    add("root_stress_" + s.mesh.gear[g] + " [MPa]", s.root_stress_max[g] * kInMegapascals);
  for (int g = 0; g < kSides; ++g)
    add("sigma_F0_" + s.mesh.gear[g] + " [MPa]", megapascal(iso.root_stress[static_cast<size_t>(g)]));
  add("sigma_H0 [MPa]", megapascal(iso.flank_pressure));
  if (pressure > 0) add("contact_pressure [MPa]", pressure * kInMegapascals);
  add("loss_factor [1]", s.loss_factor);
  add("loss_factor_rigid [1]", iso.loss_factor);
  return block;
}

// K_v over the speeds of a sweep.
FigureBlock dynamic_factor_block(const IsoComparison& iso, const ResponseResult& r) {
  FigureBlock block{"iso", {"mesh_frequency [Hz]", "K_v [1]"}, {}, "iso", ""};
  constexpr int kPoints = 400;
  const double from = r.mesh_frequency.minCoeff(), to = r.mesh_frequency.maxCoeff();
  for (int i = 0; i <= kPoints; ++i) {
    const double f = from + (to - from) * i / kPoints;
    if (const auto factor = iso.dynamic_factor(f)) block.rows.push_back({f, *factor});
  }
  return block;
}

// One line each for a picture's width.
std::vector<std::string> notes_of(const StaticResult& s, const IsoComparison& iso, bool branches) {
  std::string at_rest, by_iso;
  for (int g = 0; g < kSides; ++g) {
    at_rest +=
        text(g ? "; " : "", s.mesh.gear[g], " ", shown(s.root_stress_max[g] * kInMegapascals, 4),
             " MPa at a tangent of ", fixed(s.root_stress_angle[g] * 180 / std::numbers::pi, 0), " deg");
    if (const auto& stress = iso.root_stress[static_cast<size_t>(g)])
      by_iso += text(by_iso.empty() ? "" : "; ", s.mesh.gear[g], " ", shown(*stress * kInMegapascals, 4),
                     " MPa, ratio ", shown(s.root_stress_max[g] / *stress, 3));
  }
  std::vector<std::string> all{
      "largest tension along the root beside the loaded flank; at rest: " + at_rest,
      "in motion sustained for 1/64 of a mesh period; root stress in motion is that of the tooth loads as at rest: the inertia of the body, kept modes included, adds none"};
  if (branches)
    all.emplace_back(
        "thin lines: stable orbits of the branch, which a sweep may pass by; dots: unstable ones");
  if (!by_iso.empty())
    all.push_back("sigma_F0 of ISO 6336-3, method B, at the outer point of single contact: " + by_iso);
  if (!iso.beyond.empty())
    all.push_back("outside of the range that ISO 6336 gives for its formulas: " + iso.beyond);
  if (!iso.missing.empty()) all.push_back("left out: " + iso.missing + " (" + iso.why + ")");
  std::vector<std::string> lines;
  for (const std::string& note : all)
    for (std::string& line : in_lines(note)) lines.push_back(std::move(line));
  return lines;
}

// Of the gears: the second stands on the first, and lets it show where both are alike.
constexpr std::array kGearWidths{4.4, 1.6};

std::string gear_label(const StaticResult& s, int g) {
  return without_markup(short_name(s.mesh.gear[g]));
}

Panel root_cycle_panel(const StaticResult& s, const GearPair& pair, const IsoComparison& iso) {
  const double start = pair.path_start() / pair.base_pitch(), end = pair.path_end() / pair.base_pitch();
  Panel panel{.heading = "while a tooth passes through the mesh, at rest",
              .x = {.label = "Phase of the pair (mesh periods, 0: pitch point)",
                    .from = start - 0.35,
                    .to = end + 0.35},
              .y = {.label = "Root stress (MPa)", .from_zero = true},
              .height = 230};
  for (const double at : {start, end - 1, start + 1, end}) panel.rules.push_back({.at = at, .dash = 4});
  for (int g = 0; g < kSides; ++g) {
    panel.curves.push_back({.block = text("cycle ", g + 1),
                            .colour = curve_colour(g),
                            .label = gear_label(s, g),
                            .width = kGearWidths[g]});
    if (const auto& level = iso.root_stress[static_cast<size_t>(g)])
      panel.rules.push_back({'y', *level * kInMegapascals,
                             text("ISO 6336-3: ", fixed(*level * kInMegapascals, 0), " MPa"), curve_colour(g),
                             2, true});
  }
  return panel;
}

// A column of the sweeps, and of the branch: its stable orbits, which a sweep may pass by, and unstable ones.
void add_motion_curves(PanelCurve curve, bool branch, Panel& panel) {
  const std::string label = curve.label;
  const double width = curve.width;
  const auto add = [&](const char* block, const std::string& words, double wide, int dash) {
    curve.block = block;
    curve.label = words;
    curve.width = wide;
    curve.dash = dash;
    panel.curves.push_back(curve);
  };
  add("speed down", "", width, 3);
  add("speed up", label, width, 1);
  if (!branch) return;
  curve.where = 8;
  add("branch", "", 0.8, 1);
  curve.is = 0;
  add("branch", "", width, 6);
}

Panel speed_panel(const std::string& heading, const std::string& axis, double natural_frequency) {
  return {.heading = heading,
          .x = {.label = "Mesh frequency (Hz)", .speed = true},
          .y = {.label = axis, .from_zero = true},
          .rules = {{'x', natural_frequency, "f_n"}},
          .height = 230};
}

Panel stress_panel(const StaticResult& s, const ResponseResult& r, bool branch) {
  Panel panel = speed_panel("largest over the mesh cycle, sustained for 1/64 of it", "Root stress (MPa)",
                            r.natural_frequency);
  for (int g = 0; g < kSides; ++g)
    add_motion_curves(
        {.y = g + 2, .colour = curve_colour(g), .label = gear_label(s, g), .width = kGearWidths[g]}, branch,
        panel);
  if (branch) panel.curves.push_back({.colour = kDark, .label = "dots: unstable orbits", .dash = 6});
  panel.curves.push_back({.colour = kDark, .label = "dashed: falling", .dash = 3});
  return panel;
}

Panel factor_panel(const StaticResult& s, const ResponseResult& r, const IsoComparison& iso, bool branch) {
  Panel panel =
      speed_panel("the same over the largest at rest; root stress is quasi-static in the tooth loads",
                  "Dynamic factor (1)", r.natural_frequency);
  add_motion_curves({.y = 4, .colour = kDark, .label = "mesh force (over T / r_b)", .width = 2.2}, branch,
                    panel);
  add_motion_curves({.y = 5, .colour = kGreen, .label = "tooth load", .width = 2.2}, branch, panel);
  for (int g = 0; g < kSides; ++g)
    add_motion_curves({.y = g + 6,
                       .colour = curve_colour(g),
                       .label = "root stress, " + gear_label(s, g),
                       .width = kGearWidths[g]},
                      branch, panel);
  if (!iso.resonance) return panel;
  panel.curves.push_back(
      {.block = "iso", .colour = kPurple, .label = "K_v, ISO 6336-1 method B", .width = 2.2, .dash = 4});
  if (*iso.resonance > r.mesh_frequency.minCoeff() && *iso.resonance < r.mesh_frequency.maxCoeff())
    panel.rules.push_back({'x', *iso.resonance,
                           text("upright: N = 1 (ISO), ", fixed(*iso.resonance, 0), " Hz"), kPurple, 1,
                           true});
  return panel;
}

}  // namespace

Figure root_stress_figure(const StaticResult& s, const std::vector<ResponseResult>& sweeps,
                          const std::vector<BranchResult>& branches) {
  require_root_stresses(s, sweeps);
  if (branches.size() > 1)
    fail(Failure::input, "root-stress: ", branches.size(), " branch.h5 given, one at most");
  const GearPair pair(s);
  const AtRest rest{s.torque / pair.gear(0).base_radius(), s.tooth_load.maxCoeff(), s.contact_ratio,
                    s.root_stress_max};
  const IsoComparison iso = iso_comparison(s, sweeps[0].inertia);
  Figure figure;
  figure.title = "Root stress (MPa) and dynamic factors, " + torque_words(s.torque);
  figure.shafts = shafts_of(s);
  for (int g = 0; g < kSides; ++g) figure.blocks.push_back(cycle_block(s, g));
  for (const ResponseResult& r : sweeps)
    figure.blocks.push_back(stress_block(r, sweeps[&r == &sweeps[0] ? 1 : 0], rest));
  for (const BranchResult& b : branches) figure.blocks.push_back(branch_block(b, s, rest));
  if (iso.resonance) figure.blocks.push_back(dynamic_factor_block(iso, sweeps[0]));
  figure.blocks.push_back(rest_block(s, iso));
  figure.notes = notes_of(s, iso, !branches.empty());
  plain_captions(figure.notes.size(), figure);
  figure.panels = {root_cycle_panel(s, pair, iso), stress_panel(s, sweeps[0], !branches.empty()),
                   factor_panel(s, sweeps[0], iso, !branches.empty())};
  return figure;
}

}  // namespace whine
