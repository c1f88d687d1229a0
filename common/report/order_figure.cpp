#include "report/order_figure.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "report/response_figures.h"
#include "report/sweep_panels.h"

namespace whine {
namespace {

constexpr Eigen::Index kOrderCuts = 5;

}  // namespace

Figure order_figure(const std::vector<ResponseResult>& sweeps) {
  const auto panels = panels_of(sweeps, {});
  const auto& curve = only_curve(panels, "order cuts");
  Figure figure;
  figure.title = "Order cuts of the dynamic transmission error (DTE), " + torque_words(curve.up->torque);
  figure.notes = {
      operating_words(panels[0], {}) + "; " + panels[0].choices,
      "orders of the mesh frequency; f_n: mean natural frequency over the mesh period, contact frozen under the static load"};
  const Eigen::Index orders =
      std::min({kOrderCuts, curve.up->dte_harmonic.cols(), curve.down->dte_harmonic.cols()});
  for (const ResponseResult* r : {curve.up, curve.down}) {
    FigureBlock block{
        text("orders ", r->direction), {"mesh_frequency [Hz]"}, {}, "orders", name_of(r->direction)};
    for (Eigen::Index k = 1; k <= orders; ++k) block.columns.push_back(text("order_", k, " [µm]"));
    const std::vector<bool> broken = broken_after(*r, r == curve.up ? curve.down : curve.up);
    for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
      std::vector<double> row{r->mesh_frequency[i]};
      for (Eigen::Index k = 0; k < orders; ++k) row.push_back(r->dte_harmonic(i, k) * kMicro);
      block.rows.push_back(std::move(row));
      if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
    }
    figure.blocks.push_back(std::move(block));
  }
  figure.shafts = shafts_of_all(sweeps);
  for (Eigen::Index k = 1; k <= orders; ++k) figure.levels.push_back({text("order_", k, " [µm]"), true});
  const double f_n = curve.up->natural_frequency;
  for (const ResponseResult* r : {curve.up, curve.down}) {
    Panel panel{.heading = r == curve.up ? "speed rising" : "speed falling"};
    panel.x = {.label = "Mesh frequency (Hz)", .speed = true};
    panel.y = {.label = "Amplitude of DTE (µm)", .log = true, .decades = 4, .level = true};
    if (r == curve.up)
      panel.top = {.label = "Speed of " + without_markup(r->mesh.gear[0]) + " (rpm)"},
      panel.top_factor = 60.0 / r->gear[0].design.teeth;
    constexpr std::array kDash{1, 1, 3, 4, 5};
    for (int k = 1; k <= orders; ++k)
      panel.curves.push_back({.block = text("orders ", r->direction),
                              .y = k + 1,
                              .colour = k,
                              .label = text("order ", k),
                              .width = k == 1 ? 2.8 : 2.0,
                              .dash = kDash[k - 1]});
    panel.rules = {{'x', f_n, "f_n"}};
    figure.panels.push_back(panel);
  }
  return figure;
}

}  // namespace whine
