#include "report/order_figure.h"

#include <algorithm>
#include <limits>

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
  double from = std::numeric_limits<double>::infinity(), to = 0, largest = 0;
  for (const ResponseResult* r : {curve.up, curve.down}) {
    FigureBlock block{
        text("orders ", r->direction), {"mesh_frequency [Hz]"}, {}, "orders", name_of(r->direction)};
    for (Eigen::Index k = 1; k <= orders; ++k) block.columns.push_back(text("order_", k, " [µm]"));
    const std::vector<bool> broken = broken_after(*r, r == curve.up ? curve.down : curve.up);
    for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
      std::vector<double> row{r->mesh_frequency[i]};
      for (Eigen::Index k = 0; k < orders; ++k) {
        row.push_back(r->dte_harmonic(i, k) * kMicro);
        largest = std::max(largest, row.back());
      }
      block.rows.push_back(std::move(row));
      if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
    }
    figure.blocks.push_back(std::move(block));
    from = std::min(from, r->mesh_frequency.minCoeff());
    to = std::max(to, r->mesh_frequency.maxCoeff());
  }
  figure.shafts = shafts_of_all(sweeps);
  for (Eigen::Index k = 1; k <= orders; ++k) figure.levels.push_back({text("order_", k, " [µm]"), true});
  figure.words.emplace_back("driver", without_markup(curve.up->mesh.gear[0]));
  for (const auto& [name, value] :
       {std::pair{"orders", static_cast<double>(orders)}, std::pair{"largest", largest},
        std::pair{"frequency_from", from}, std::pair{"frequency_to", to},
        std::pair{"natural_frequency", curve.up->natural_frequency},
        std::pair{"rpm_per_hertz", 60.0 / curve.up->gear[0].design.teeth}})
    figure.numbers.emplace_back(name, value);
  figure.height = 1240;
  return figure;
}

}  // namespace whine
