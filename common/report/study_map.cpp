// Response quantities of a study as cells over two of its keys or quantities, with the limits of contact loss beside them.
#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "base/error.h"
#include "gear/contact_lines.h"
#include "report/figure_list.h"
#include "report/figure_words.h"
#include "report/study_axes.h"

namespace whine {
namespace {

using Eigen::Index;

// What runs along a side of a map: value of each variant in the unit of the figure, edges of its cell.
struct MapSide {
  std::string label;
  std::vector<double> at, from, to;
  // Ends of the axis: where all rows have cells.
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

MapSide map_side(const StudyResult& a, const std::string& name) {
  const size_t variants = a.variants.size();
  MapSide side;
  for (size_t k = 0; k < a.plan.keys.size(); ++k)
    if (a.plan.keys[k].name == name) {
      const StudyAxis axis = axis_of(a, k);
      const AxisUnits units = axis_units(a.plan.keys[k], *std::max_element(axis.at.begin(), axis.at.end()));
      side.label = with_unit(axis_name(a.plan.keys[k]), units.words);
      for (const double value : axis.at) side.at.push_back(value * units.scale);
    }
  if (side.at.empty()) {
    const ShownUnit unit = shown_units(kind_of(a, name).units);
    side.label = with_unit(label_of(name), unit.units);
    for (size_t v = 0; v < variants; ++v)
      side.at.push_back(a.quantity(static_cast<Index>(v), quantity_of(a, name)) * unit.scale);
  }
  side.from = side.to = side.at;
  return side;
}

// Edges between neighbours along key k, those that agree in the other key, and as far beyond the ends.
void set_edges(const StudyResult& a, size_t k, MapSide& side) {
  std::map<std::string, std::vector<size_t>> rows;  // by the value of the other key
  for (size_t v = 0; v < a.variants.size(); ++v)
    if (a.rejection[v].empty()) rows[a.variants[v].values[1 - k]].push_back(v);
  for (auto& [value, row] : rows) {
    std::sort(row.begin(), row.end(), [&](size_t i, size_t j) { return side.at[i] < side.at[j]; });
    for (size_t i = 0; i + 1 < row.size(); ++i)
      side.to[row[i]] = side.from[row[i + 1]] = 0.5 * (side.at[row[i]] + side.at[row[i + 1]]);
    const size_t first = row.front(), last = row.back();
    side.from[first] = 2 * side.at[first] - side.to[first];
    side.to[last] = 2 * side.at[last] - side.from[last];
    side.least = std::max(side.least, side.from[first]);
    side.most = std::min(side.most, side.to[last]);
  }
}

bool gathers(const StudyResult& a, const std::string& name) {
  const std::vector<std::string>& all = a.plan.quantities;
  return std::find(all.begin(), all.end(), name) != all.end();
}

// Damping ratios below which one degree of freedom loses contact, half of the first harmonic over the mean of what excites it: of the
// length of the contact lines, and of the static transmission error.
std::vector<PanelCurve> add_limits(const StudyResult& a, const MapSide& x, Figure& figure) {
  std::vector<PanelCurve> curves;
  if (a.plan.figure_map != std::vector<std::string>{"overlap_ratio", "rayleigh_damping_ratio"}) return curves;
  const auto of = [&](size_t v, const char* name) {
    return a.quantity(static_cast<Index>(v), quantity_of(a, name));
  };
  const size_t drawn =
      static_cast<size_t>(std::find(a.rejection.begin(), a.rejection.end(), "") - a.rejection.begin());
  const std::vector<std::string> columns{"overlap ratio [1]", "damping ratio [1]"};
  if (gathers(a, "contact_ratio")) {
    FigureBlock rule{"contact lines", columns, {}};
    constexpr int kPoints = 80;
    for (int i = 0; i <= kPoints; ++i) {
      const double overlap = x.least + (x.most - x.least) * i / kPoints;
      rule.rows.push_back({overlap, 0.5 * contact_line_harmonic(of(drawn, "contact_ratio"), overlap)});
    }
    curves.push_back(
        {.block = rule.name, .colour = kBlack, .label = "one degree, by contact lines", .width = 2.6});
    figure.blocks.push_back(rule);
  }
  if (gathers(a, "te_mean") && gathers(a, "te_harmonic_1")) {
    std::map<double, double> limit;
    for (size_t v = 0; v < x.at.size(); ++v)
      if (a.rejection[v].empty()) limit[x.at[v]] = 0.5 * of(v, "te_harmonic_1") / of(v, "te_mean");
    FigureBlock rule{"static TE", columns, {}};
    for (const auto& [overlap, ratio] : limit) rule.rows.push_back({overlap, ratio});
    curves.push_back({.block = rule.name,
                      .style = PanelStyle::line_points,
                      .colour = kGreen,
                      .label = "one degree, by the static TE",
                      .width = 2.2,
                      .dash = 2});
    figure.blocks.push_back(rule);
  }
  return curves;
}

}  // namespace

void add_study_map(const StudyResult& a, const std::vector<std::string>& quantities, Figure& figure) {
  std::array<MapSide, 2> side{map_side(a, a.plan.figure_map[0]), map_side(a, a.plan.figure_map[1])};
  // Which key moves a side: the one along which it changes more than its ends do from row to row.
  const auto along = [&](MapSide of, size_t k) {
    set_edges(a, k, of);
    double change = 0;
    for (size_t v = 0; v < of.at.size(); ++v) change = std::max(change, of.to[v] - of.from[v]);
    return change;
  };
  const size_t key = along(side[0], 0) >= along(side[0], 1) ? 0 : 1;
  for (size_t s = 0; s < side.size(); ++s) {
    set_edges(a, s == 0 ? key : 1 - key, side[s]);
    if (!(along(side[s], s == 0 ? key : 1 - key) > along(side[s], s == 0 ? 1 - key : key)))
      fail(Failure::input, "the map of the study has no cells: ", a.plan.figure_map[s],
           " does not follow a key of its own; take others for 'map' in [figure]");
  }
  const std::vector<PanelCurve> limits = add_limits(a, side[0], figure);
  for (const std::string& name : quantities) {
    const ShownUnit unit = shown_units(kind_of(a, name).units);
    FigureBlock block{text("map ", name),
                      {side[0].label, side[1].label, name, "from", "to", "from", "to", "unsteady"},
                      {},
                      "",
                      "",
                      true};
    double most = 0;
    bool crossed = false;
    for (size_t v = 0; v < a.variants.size(); ++v) {
      if (!a.rejection[v].empty()) continue;
      const double value = a.quantity(static_cast<Index>(v), quantity_of(a, name)) * unit.scale;
      const int unsteady = of_motion(name) ? a.unsteady[static_cast<Index>(v)] : 0;
      most = std::max(most, value);
      crossed |= unsteady > 0;
      block.rows.push_back({side[0].at[v], side[1].at[v], value, side[0].from[v], side[0].to[v],
                            side[1].from[v], side[1].to[v], static_cast<double>(unsteady)});
    }
    figure.blocks.push_back(block);
    PanelCurve none{.block = block.name, .style = PanelStyle::cells, .colour = kLight, .box = {4, 5, 6, 7}};
    PanelCurve cells = none;
    cells.where = cells.heat = 3;
    Panel panel{.heading = label_of(name) + ", grey: 0",
                .x = {.label = side[0].label, .from = side[0].least, .to = side[0].most},
                .y = {.label = side[1].label, .from = side[1].least, .to = side[1].most},
                .curves = {none, cells},
                .key = PanelKey::below,
                .height = 420,
                .colours = PanelAxis{
                    .label = *unit.units ? unit.units : "share", .from = 0, .to = most > 0 ? most : 1}};
    if (crossed)
      panel.curves.push_back({.block = block.name,
                              .style = PanelStyle::points,
                              .colour = kVermilion,
                              .label = "not settled",
                              .width = 1.8,
                              .mark = 2,
                              .size = 1.8,
                              .where = 8});
    panel.curves.insert(panel.curves.end(), limits.begin(), limits.end());
    figure.panels.push_back(panel);
  }
  figure.columns = std::min<size_t>(2, quantities.size());
}

}  // namespace whine
