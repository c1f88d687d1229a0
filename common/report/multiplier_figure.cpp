#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "signal/jump_words.h"

namespace whine {

using Eigen::Index;

Figure multiplier_figure(const BranchResult& b) {
  constexpr double kLeast = 0.05;  // modulus that is shown
  const Index n = b.mesh_frequency.size();
  if (n == 0) fail(Failure::input, "a figure of multipliers needs a branch with one orbit at least");
  Figure figure;
  figure.title = "Floquet multipliers along the branch of periodic orbits, " +
                 (b.of_train() ? "of a train" : torque_words(b.torque));
  FigureBlock plane{"multipliers", {"real", "imaginary", "mesh_frequency [Hz]", "stable"}, {}};
  FigureBlock modulus{"modulus", {"mesh_frequency [Hz]", "largest modulus", "stable"}, {}};
  double largest = 1;
  for (Index i = 0; i < n; ++i) {
    const MatrixRM& all = b.floquet_multiplier[static_cast<size_t>(i)];
    for (Index k = 0; k < all.rows(); ++k)
      if (all.row(k).norm() > kLeast)
        plane.rows.push_back({all(k, 0), all(k, 1), b.mesh_frequency[i], static_cast<double>(b.stable[i])});
    modulus.rows.push_back({b.mesh_frequency[i], all.row(0).norm(), static_cast<double>(b.stable[i])});
    largest = std::max(largest, all.row(0).norm());
  }
  figure.blocks = {std::move(plane), std::move(modulus)};
  for (Index i = 0; i < b.fold_frequency.size(); ++i)
    figure.notes.push_back(text("fold at ",
                                jump_words(b.fold_frequency.segment(i, 1), b.fold_width.segment(i, 1)), ", ",
                                b.fold_smooth[i] ? "smooth" : "at a kink",
                                ": real multiplier nearest to 1: ", fixed(b.fold_multiplier(i, 0), 5),
                                " before the fold, ", fixed(b.fold_multiplier(i, 1), 5), " after it"));
  figure.notes.push_back(text(n, " orbits, ", n - b.stable.sum(), " unstable; ", b.flip_frequency.size(),
                              " period doublings, ", b.torus_frequency.size(), " tori"));
  FigureBlock circle{"unit circle", {"real", "imaginary"}, {}};
  circle.drawing = true;
  for (int i = 0; i <= 180; ++i) circle.rows.push_back({std::cos(kPi * i / 90), std::sin(kPi * i / 90)});
  figure.blocks.push_back(std::move(circle));
  figure.captions = figure.notes;
  const double reach = 1.05 * std::max(largest, 1.05);
  const PanelAxis part{.label = "Real part", .from = -reach, .to = reach};
  Panel plane_panel{.x = part, .y = part, .key = PanelKey::none, .height = 560, .square = true};
  plane_panel.y.label = "Imaginary part";
  plane_panel.colours = {
      .label = "Mesh frequency (Hz)", .from = b.mesh_frequency.minCoeff(), .to = b.mesh_frequency.maxCoeff()};
  plane_panel.curves = {{.block = "unit circle", .colour = kDark, .width = 2}};
  Panel modulus_panel{.x = {.label = "Mesh frequency (Hz)"},
                      .y = {.label = "Largest modulus", .from = 0, .to = 1.15 * reach},
                      .curves = {{.block = "modulus", .colour = kLight, .width = 1.2}},
                      .rules = {{'y', 1, "", kDark, 1}},
                      .key = PanelKey::below,
                      .height = 560};
  for (const bool stable : {true, false}) {
    PanelCurve marks{.block = "multipliers",
                     .style = PanelStyle::points,
                     .mark = stable ? 7 : 6,
                     .size = stable ? 0.9 : 1.4,
                     .where = 4,
                     .is = stable ? 1 : 0,
                     .heat = 3};
    plane_panel.curves.push_back(marks);
    marks.block = "modulus";
    marks.where = 3;
    marks.heat = 0;
    marks.colour = stable ? kBlue : kVermilion;
    marks.label = stable ? "stable" : "unstable";
    modulus_panel.curves.push_back(marks);
  }
  figure.panels = {std::move(plane_panel), std::move(modulus_panel)};
  figure.columns = 2;
  return figure;
}

}  // namespace whine
