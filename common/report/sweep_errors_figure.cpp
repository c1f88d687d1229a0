#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "report/figure_words.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr double kLeastShown = 1e-5;  // %

// Errors in %, of the mesh where they are largest: in all, then by what was refined, by rising speed.
FigureBlock errors_block(const SweepErrorsResult& a) {
  FigureBlock block{text("errors ", a.direction),
                    {"mesh_frequency [Hz]", "error_in_all [%]"},
                    {},
                    "errors",
                    name_of(a.direction)};
  for (const std::string& entry : a.entry) block.columns.push_back(entry + " [%]");
  std::vector<Index> order;
  for (Index i = 0; i < a.mesh_frequency.size(); ++i) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j) { return a.mesh_frequency[i] < a.mesh_frequency[j]; });
  for (const Index i : order) {
    std::vector<double> row{a.mesh_frequency[i], a.dte_rms.error.row(i).maxCoeff() * kPercent};
    for (size_t e = 0; e < a.entry.size(); ++e)
      row.push_back(a.dte_rms.change[e].row(i).cwiseAbs().maxCoeff() * kPercent);
    block.rows.push_back(std::move(row));
  }
  return block;
}

FigureBlock rms_block(const SweepErrorsResult& a) {
  FigureBlock block{text("motion ", a.direction),
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "least [µm]", "most [µm]"},
                    {},
                    "motion",
                    name_of(a.direction)};
  for (Index i = 0; i < a.mesh_frequency.size(); ++i) {
    const double rms = a.dte_rms.value(i, 0) * kMicro, off = rms * a.dte_rms.error(i, 0);
    block.rows.push_back({a.mesh_frequency[i], rms, std::max(0.0, rms - off), rms + off});
    const double next = i + 1 < a.mesh_frequency.size() ? a.mesh_frequency[i + 1] : a.mesh_frequency[i];
    if ((a.jump_frequency.array() > std::min(a.mesh_frequency[i], next) &&
         a.jump_frequency.array() < std::max(a.mesh_frequency[i], next))
            .any())
      block.rows.emplace_back();
  }
  return block;
}

// A star: refined sweeps among them do not jump there.
std::string jumps_note(const SweepErrorsResult& a) {
  std::string words = text("jumps, speed ", a.direction == Direction::up ? "rising" : "falling", ":");
  for (Index j = 0; j < a.jump_frequency.size(); ++j)
    words += text(j ? ", " : " ", told(a.jump_frequency[j], a.jump_error[j], 6).words(), " Hz",
                  a.jump_found.col(j).minCoeff() == 0 ? "*" : "");
  return a.jump_frequency.size() > 0 ? words : words + " none";
}

Panel errors_panel(const SweepErrorsResult& a, const FigureBlock& block) {
  Panel panel{.x = {.label = "Mesh frequency (Hz)", .speed = true},
              .y = {.label = text("Error (%), ", a.direction), .from = kLeastShown, .log = true},
              .height = 420};
  panel.curves.push_back({.block = block.name, .colour = kBlack, .label = "in all", .width = 3.6});
  for (size_t e = 0; e < a.entry.size(); ++e) {
    const double order = a.order[static_cast<Index>(e)];
    panel.curves.push_back(
        {.block = block.name,
         .y = static_cast<int>(e) + 3,
         .style = PanelStyle::line_points,
         .colour = curve_colour(e),
         .label = without_markup(a.entry[e]) + (order > 0 ? ", order " + fixed(order, 1) : ""),
         .width = 1.6,
         .size = 0.8});
  }
  return panel;
}

}  // namespace

Figure sweep_errors_figure(const std::vector<SweepErrorsResult>& sweeps) {
  if (sweeps.empty() || sweeps.size() > 2 ||
      (sweeps.size() == 2 && sweeps[0].direction == sweeps[1].direction))
    fail(Failure::input, "motion-errors: takes one sweep_errors.h5, or one of each direction");
  Figure figure;
  figure.title = "Discretisation errors of the motion";
  if (!sweeps[0].of_train()) figure.title += ", " + torque_words(sweeps[0].torque);
  Panel motion{.x = {.speed = true}, .y = {.label = "RMS of DTE (µm)", .from_zero = true, .level = true}};
  for (const SweepErrorsResult& a : sweeps) {
    figure.blocks.push_back(rms_block(a));
    const int colour = a.direction == Direction::up ? kBlue : kVermilion;
    motion.curves.push_back({.block = figure.blocks.back().name, .colour = colour, .width = 1.2});
    motion.curves.push_back({.block = figure.blocks.back().name,
                             .style = PanelStyle::ranges,
                             .colour = colour,
                             .label = a.direction == Direction::up ? "speed rising" : "speed falling",
                             .size = 0.8,
                             .box = {1, 1, 3, 4}});
    figure.notes.push_back(jumps_note(a));
  }
  figure.panels.push_back(std::move(motion));
  for (const SweepErrorsResult& a : sweeps) {
    figure.blocks.push_back(errors_block(a));
    figure.panels.push_back(errors_panel(a, figure.blocks.back()));
  }
  for (size_t p = 0; p + 1 < figure.panels.size(); ++p) figure.panels[p].x.label.clear();
  if (sweeps[0].of_train())
    figure.notes.push_back(text("RMS: of ", short_name(sweeps[0].mesh_names.at(0)),
                                "; errors: at each speed of the mesh where they are largest"));
  figure.notes.push_back(
      "each discretisation alone twice as fine (modes 1.5 times as many); in all: sum of the changes, each with the order with which its error falls, where one shows; *: not in all refined sweeps");
  plain_captions(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
