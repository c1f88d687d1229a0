#include "report/figure_list.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "report/figure_words.h"

namespace whine {
namespace {

// Root stress with elements of several sizes on the roots, and a note of what they change in all; no rows without it.
FigureBlock root_levels(const ErrorBudgetResult& budget, std::vector<std::string>& notes) {
  FigureBlock roots{"roots", {"element [mm]"}, {}, "roots", "largest root stress"};
  if (const RootConvergence root = convergence(budget.root); root.order.rows() > 0) {
    std::string words = "root stress with smaller elements on the roots:";
    for (Eigen::Index g = 0; g < root.order.cols(); ++g) {
      const Eigen::Index last = root.change.rows() - 1;
      const double order = resolved_order(root, last - 1, g);
      // What the finest still changes the result by, and the last order.
      const std::string& name = budget.gear_names[static_cast<size_t>(g)];
      words += text(g ? "; " : " ", name, " ",
                    shown((budget.root.stress(last + 1, g) / budget.root.stress(0, g) - 1) * kPercent, 2),
                    " % from ", shown(budget.root.element_size[0] * 1e3, 3), " to ",
                    shown(budget.root.element_size[last + 1] * 1e3, 3), " mm",
                    std::isfinite(order) ? ", order " + fixed(order, 1) : "");
      roots.columns.push_back(text("stress of ", name, " [MPa]"));
    }
    for (Eigen::Index k = 0; k < budget.root.stress.rows(); ++k) {
      std::vector<double>& row = roots.rows.emplace_back(1, budget.root.element_size[k] * 1e3);
      for (const double stress : budget.root.stress.row(k)) row.push_back(stress * 1e-6);
    }
    notes.push_back(words);
  }
  return roots;
}

// A quantity whose relative changes are drawn.
struct Judged {
  std::string column, label;
  int colour;
  Eigen::VectorXd change;  // (entry) 1
};

std::vector<Judged> judged_of(const StaticChanges& c) {
  constexpr std::array kGreys{kBlack, kDark, kMedium, kGrey, kLight};
  std::vector<Judged> out{{"mean_stiffness [%]", "mean stiffness", kBlue, c.mean_stiffness_change},
                          {"peak_to_peak [%]", "peak to peak", kVermilion, c.peak_to_peak_change}};
  for (Eigen::Index n = 0; n < c.harmonic_change.cols(); ++n)
    out.push_back({text("harmonic_", n + 1, " [% of the first]"), text("harmonic ", n + 1),
                   kGreys.at(static_cast<size_t>(n)), c.harmonic_change.col(n)});
  for (const Judged& one : {Judged{"flank_pressure [%]", "flank pressure", kGreen, c.pressure_change},
                            Judged{"root_stress [%]", "root stress", kPurple, c.root_stress_change},
                            Judged{"load_factor [%]", "K_{Hβ}", kOrange, c.load_factor_change}})
    if (one.change.size() > 0) out.push_back(one);
  return out;
}

}  // namespace

Figure error_budget_figure(const ErrorBudgetResult& budget) {
  Figure figure;
  figure.title = text("Error budget of the static transmission error, ", shown(budget.torque, 6), " N m");
  figure.notes.push_back(
      text("each discretisation alone twice as fine; that stands for an error of the mean stiffness of ",
           shown(budget.refinement.error(&StaticChanges::mean_stiffness_change) * kPercent, 3), " %"));
  const bool over_face = budget.fidelity.width != WidthModel::one;
  figure.notes.push_back(
      text(over_face ? text("width = ", budget.fidelity.width) : text("contact = ", budget.fidelity.contact),
           ", near field by ", budget.gear[0].discretisation.near_field,
           budget.fidelity.width == WidthModel::body
               ? "; degree: what two degrees less change"
               : "; beyond the line what another choice changes, which is no error of this one"));
  const FigureBlock roots = root_levels(budget, figure.notes);
  double largest = 1;  // %
  Panel panel{.y = {.label = "Change (%)", .from = 1e-5, .log = true}, .key = PanelKey::below, .height = 560};
  for (const auto& [name, changes] :
       {std::pair{"changes", &budget.refinement}, {"choices", &budget.choice}}) {
    const bool errors = changes == &budget.refinement;
    FigureBlock block{name, {"entry [1]"}, {}, "", "", true};
    const std::vector<Judged> judged = judged_of(*changes);
    const double step = std::min(0.1, 0.9 / static_cast<double>(judged.size()));
    for (size_t k = 0; k < judged.size(); ++k) {
      block.columns.push_back(judged[k].column);
      panel.curves.push_back(
          {.block = name,
           .y = static_cast<int>(k) + 2,
           .style = PanelStyle::bars,
           .colour = judged[k].colour,
           .label = errors ? judged[k].label : "",
           .width = 0.95 * step,
           .shift = step * (static_cast<double>(k) - 0.5 * (static_cast<double>(judged.size()) - 1)) + 1 +
                    static_cast<double>(panel.x.names.size())});
    }
    std::string rest = changes->entry;
    for (Eigen::Index i = 0; i < changes->mean_stiffness_change.size(); ++i) {
      std::vector<double> row{static_cast<double>(i)}, with_signs{errors ? 1.0 : 0.0};
      for (const Judged& one : judged) {
        row.push_back(std::abs(one.change[i]) * kPercent);
        with_signs.push_back(one.change[i] * kPercent);
      }
      block.rows.push_back(row);
      largest = std::max(largest, *std::max_element(row.begin() + 1, row.end()));
      const size_t comma = rest.find(", ");
      std::string label = rest.substr(0, comma);
      // The same numbers under the name of what is changed, and with their signs.
      FigureBlock named{text(name, " ", i), block.columns, {with_signs}, "changes", label};
      named.columns[0] = "error [1 yes, 0 another choice]";
      figure.blocks.push_back(named);
      // The values on a line of their own.
      const size_t value = std::min(label.find(" at "), label.find_first_of("0123456789") - 1);
      panel.x.names.push_back(value < label.size() ? label.substr(0, value) + "\n" + label.substr(value + 1)
                                                   : label);
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
    figure.blocks.push_back(block);
  }
  if (!roots.rows.empty()) figure.blocks.push_back(roots);
  const auto errors = static_cast<double>(budget.refinement.mean_stiffness_change.size()),
             choices = static_cast<double>(budget.choice.mean_stiffness_change.size());
  if (choices > 0) {
    panel.rules = {{'x', errors + 0.5, "", kDark, 1}};
    panel.words = {{"errors", 0.5 * (errors + 1)}, {"other choices", errors + 0.5 * (choices + 1)}};
  }
  panel.y.to = std::pow(10, std::floor(std::log10(largest)) + 1);
  figure.panels = {panel};
  plain_captions(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
