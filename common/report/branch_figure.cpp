#include "report/figure_list.h"

#include <algorithm>

#include "base/error.h"
#include "report/distinct_curves.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "signal/jump_words.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr size_t kMostMeshes = 8;  // curves that can be told apart beside their sweeps

std::string rms_column(const MotionSource& a, size_t mesh) {
  return text("dte_rms ", a.mesh_names[mesh], " [µm]");
}

// Where stability changes the curve of the other kind begins with the last point of this one; parts are curves of their own.
FigureBlock branch_block(const BranchResult& b, size_t meshes, bool stable) {
  FigureBlock block{stable ? "stable" : "unstable",
                    {"mesh_frequency [Hz]", "largest multiplier"},
                    {},
                    stable ? "stable" : "unstable"};
  for (size_t m = 0; m < meshes; ++m) block.columns.push_back(rms_column(b, m));
  for (Index i = 0; i < b.mesh_frequency.size(); ++i) {
    const bool goes_on = i > 0 && (b.part[i] == b.part[i - 1]);
    const bool own = (b.stable[i] != 0) == stable, before = goes_on && (b.stable[i - 1] != 0) == stable;
    if (i > 0 && !goes_on && !block.rows.empty() && !block.rows.back().empty())
      block.rows.emplace_back();  // lifts the pen
    if (!own && !before) continue;
    std::vector<double> row{b.mesh_frequency[i], b.floquet_multiplier[static_cast<size_t>(i)].row(0).norm()};
    row.reserve(meshes + 2);
    for (size_t m = 0; m < meshes; ++m) row.push_back(b.dte_rms(i, static_cast<Index>(m)) * kMicro);
    block.rows.push_back(row);
    if (!own) block.rows.emplace_back();  // lifts the pen
  }
  return block;
}

FigureBlock sweep_block(const BranchResult& b, const ResponseResult& s, size_t meshes) {
  const std::string way = text("sweep ", name_of(s.direction));
  FigureBlock block{way, {"mesh_frequency [Hz]"}, {}, text("sweep_", name_of(s.direction))};
  for (size_t m = 0; m < meshes; ++m) block.columns.push_back(rms_column(b, m));
  for (Index i = 0; i < s.mesh_frequency.size(); ++i) {
    if (i > 0 && jumps_between(s, s.mesh_frequency[i - 1], s.mesh_frequency[i])) block.rows.emplace_back();
    std::vector<double> row{s.mesh_frequency[i]};
    row.reserve(meshes + 1);
    for (size_t m = 0; m < meshes; ++m) row.push_back(s.dte_rms(i, static_cast<Index>(m)) * kMicro);
    block.rows.push_back(row);
  }
  return block;
}

// How the points of a block are drawn, in the figure's blocks of stable and unstable orbits and of sweeps.
PanelCurve look_of(const std::string& block) {
  if (block == "stable") return {.block = block, .label = "stable orbits"};
  if (block == "unstable") return {.block = block, .label = "unstable orbits", .width = 2, .dash = 4};
  const bool up = block == "sweep up";
  return {.block = block,
          .style = PanelStyle::points,
          .label = up ? "sweep, rising" : "sweep, falling",
          .width = 1.5,
          .mark = up ? 2 : 6,
          .size = up ? 0.9 : 1.1};
}

// numbers: of the meshes among those that differ. Where they are near each other for a while, the wider line below shows.
Panel vibration_panel(const BranchResult& b, const std::vector<FigureBlock>& blocks,
                      const std::vector<size_t>& numbers) {
  const size_t meshes = numbers.size(), distinct = count_of_distinct(numbers);
  Panel panel{.heading = "RMS of the transmission error",
              .x = {.label = "Mesh frequency (Hz)", .speed = true},
              .y = {.label = "RMS (µm)", .from_zero = true, .level = true},
              .height = 560};
  for (size_t m = 0; m < meshes; ++m)
    panel.curves.push_back({.colour = curve_colour(numbers[m]),
                            .label = without_markup(short_name(b.mesh_names[m])),
                            .width = 3,
                            .dash = numbers[m] < 6 ? 1 : 2});
  for (const FigureBlock& block : blocks) {
    const PanelCurve look = look_of(block.name);
    for (size_t m = 0; m < meshes; ++m) {
      if (!is_first(numbers, m)) continue;
      PanelCurve curve = look;
      curve.y = static_cast<int>(m) + (look.style == PanelStyle::line ? 3 : 2);
      curve.colour = curve_colour(numbers[m]);
      curve.label = "";
      if (block.name == "stable") {
        curve.width = 2 + 1.2 * static_cast<double>(distinct - 1 - numbers[m]);
        curve.dash = panel.curves[m].dash;
      }
      panel.curves.push_back(curve);
    }
    panel.curves.push_back(look);
    panel.curves.back().block = "";
    panel.curves.back().colour = kBlack;
  }
  return panel;
}

Panel multiplier_panel(const std::vector<FigureBlock>& blocks) {
  Panel panel{.heading = "largest Floquet multiplier",
              .x = {.label = "Mesh frequency (Hz)", .speed = true},
              .y = {.label = "Modulus (1)", .from_zero = true},
              .rules = {{'y', 1, "", kDark, 1}},
              .height = 240};
  for (const FigureBlock& block : blocks)
    if (PanelCurve curve = look_of(block.name); curve.style == PanelStyle::line) {
      curve.colour = block.name == "stable" ? kBlue : kVermilion;
      panel.curves.push_back(curve);
    }
  return panel;
}

}  // namespace

Figure branch_figure(const BranchResult& b, const std::vector<ResponseResult>& sweeps) {
  if (b.mesh_frequency.size() == 0) fail(Failure::input, "figure: the branch holds no orbit");
  require_one_system("the branch", b, sweeps);
  const size_t meshes = std::min(b.mesh_names.size(), kMostMeshes);
  Figure figure;
  figure.title =
      text("Branch of periodic motions", b.of_train() ? " of a train" : ", " + torque_words(b.torque));
  const bool unstable = b.stable.minCoeff() == 0, stable = b.stable.maxCoeff() == 1;
  if (stable) figure.blocks.push_back(branch_block(b, meshes, true));
  if (unstable) figure.blocks.push_back(branch_block(b, meshes, false));
  for (const ResponseResult& sweep : sweeps) figure.blocks.push_back(sweep_block(b, sweep, meshes));
  for (size_t m = 0; m < meshes; ++m) figure.levels.push_back({rms_column(b, m), false});
  figure.notes.push_back(text(b.mesh_frequency.size(), " orbits, ", b.mesh_frequency.size() - b.stable.sum(),
                              " unstable, ", b.fold_frequency.size(), " folds, ", b.flip_frequency.size(),
                              " period doublings, ", b.torus_frequency.size(), " tori; body \"",
                              b.fidelity.body, "\", contact \"", b.fidelity.contact, "\""));
  constexpr Index kShownFolds = 6;
  for (Index i = 0; i < std::min<Index>(b.fold_frequency.size(), kShownFolds); ++i)
    figure.notes.push_back(text("fold at ",
                                jump_words(b.fold_frequency.segment(i, 1), b.fold_width.segment(i, 1)), ", ",
                                b.fold_smooth[i] ? "smooth" : "at a kink"));
  if (const Index more = b.fold_frequency.size() - kShownFolds; more > 0)
    figure.notes.push_back(text(more, more == 1 ? " more fold is" : " more folds are", " in ",
                                without_markup("/fold_frequency"), " of branch.h5"));
  if (b.mesh_names.size() > meshes)
    figure.notes.push_back(text("the first ", meshes, " of ", b.mesh_names.size(), " meshes"));
  std::vector<Eigen::VectorXd> vibration;
  vibration.reserve(meshes);
  for (size_t m = 0; m < meshes; ++m) vibration.emplace_back(b.dte_rms.col(static_cast<Index>(m)));
  const std::vector<size_t> numbers = distinct_curves(vibration, b.dte_rms.maxCoeff());
  if (count_of_distinct(numbers) < meshes) figure.notes.emplace_back(kOneColour);
  figure.panels = {vibration_panel(b, figure.blocks, numbers), multiplier_panel(figure.blocks)};
  add_shafts(b, figure);
  return figure;
}

}  // namespace whine
