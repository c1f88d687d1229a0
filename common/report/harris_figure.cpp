#include "report/figure_list.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/level_lines.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// The relief at which lines through the values on either side of the least one meet, as in a cusp: on the grid of the map the
// best relief would go in steps, and about its least value a map is flat. Beside an end of the grid, where torques are small and
// the flat is narrow, the lines are of the places that are there. That of the least value where they do not meet near it.
// Where a relief hardly helps, as one that is too short, values are within kAlike of the least one over many places, and which of
// them is least is chance: the middle of that range then.
double best_relief(const VectorXd& relief, const Eigen::RowVectorXd& value) {
  constexpr Index kFar = 4;  // places from the least value; the line goes through that and the one before
  constexpr double kAlike = 0.005;
  Index r = 0;
  const double level = (1 + kAlike) * value.minCoeff(&r);
  const auto crossing = [&](Index step) {
    Index i = r;
    while (i + step >= 0 && i + step < relief.size() && value[i + step] <= level) i += step;
    if (i + step < 0 || i + step >= relief.size()) return relief[i];
    return relief[i] + (relief[i + step] - relief[i]) * (level - value[i]) / (value[i + step] - value[i]);
  };
  const double from = crossing(-1), to = crossing(1);
  if (to - from > relief[std::min(r + kFar, relief.size() - 1)] - relief[r]) return 0.5 * (from + to);
  const Index below = std::min(kFar, r), above = std::min(kFar, relief.size() - 1 - r);
  if (below < 1 || above < 2) return relief[r];
  const Index low = r - below + 1, high = r + above - 1;
  const double falling = (value[low] - value[low - 1]) / (relief[low] - relief[low - 1]),
               rising = (value[high + 1] - value[high]) / (relief[high + 1] - relief[high]);
  if (!(falling < 0 && rising > 0)) return relief[r];
  const double at =
      (value[high] - value[low] + falling * relief[low] - rising * relief[high]) / (falling - rising);
  return std::clamp(at, relief[low], relief[high]);
}

std::vector<double> edges_of(const VectorXd& middle) {
  return cell_edges({middle.begin(), middle.end()});
}

constexpr int kPeakToPeak = 3, kEdges = 7, kDynamicRms = 11;  // columns of the map

// Of that length of relief every quantity over relief and torque, and the edges of its cells.
FigureBlock map_block(const HarrisMapResult& map, size_t length) {
  FigureBlock out{"map", {"relief [µm]", "torque [N m]", "peak to peak [µm]"}, {}};
  for (int n = 0; n < 3; ++n) out.columns.push_back(text("harmonic ", n + 1, " [µm]"));
  for (const char* edge : {"relief_low [µm]", "relief_high [µm]", "torque_low [N m]", "torque_high [N m]"})
    out.columns.emplace_back(edge);
  if (!map.dynamic_rms.empty())
    out.columns.insert(out.columns.end(), {"dte_rms [µm]", "at mesh_frequency [Hz]"});
  const std::vector<double> x = edges_of(map.relief * kMicro), y = edges_of(map.torque);
  for (Index t = 0; t < map.torque.size(); ++t)
    for (Index r = 0; r < map.relief.size(); ++r) {
      std::vector<double> row{map.relief[r] * kMicro, map.torque[t], map.peak_to_peak[length](t, r) * kMicro};
      for (const auto& harmonic : map.harmonic) row.push_back(harmonic[length](t, r) * kMicro);
      const auto i = static_cast<size_t>(r), k = static_cast<size_t>(t);
      row.insert(row.end(), {x[i], x[i + 1], y[k], y[k + 1]});
      if (!map.dynamic_rms.empty())
        row.insert(row.end(), {map.dynamic_rms[length](t, r) * kMicro, map.worst_frequency[length](t, r)});
      out.rows.push_back(row);
    }
  return out;
}

// A column of the map as colours, with lines of equal value.
Panel map_panel(const HarrisMapResult& map, const MatrixRM& values, int column, const std::string& heading,
                const std::string& label, Figure& figure) {
  constexpr int kLines = 10;
  const std::vector<double> x = edges_of(map.relief * kMicro), y = edges_of(map.torque);
  const double most = values.maxCoeff() * kMicro;
  LevelLines lines = level_lines("lines of " + label, {"relief [µm]", "torque [N m]"}, map.relief * kMicro,
                                 map.torque, values * kMicro, kLines);
  Panel panel{.heading = heading,
              .x = {.label = "Tip relief (µm)", .from = x.front(), .to = x.back()},
              .y = {.label = "Torque (N m)", .from = y.front(), .to = y.back()},
              .curves = {{.block = "map",
                          .style = PanelStyle::cells,
                          .box = {kEdges, kEdges + 1, kEdges + 2, kEdges + 3},
                          .heat = column},
                         {.block = lines.lines.name, .colour = kMedium, .width = 1}},
              .key = PanelKey::none,
              .height = 560,
              .colours = PanelAxis{.label = label, .from = 0, .to = most > 0 ? most : 1},
              .words = lines.numbers};
  figure.blocks.push_back(std::move(lines.lines));
  return panel;
}

// Over torque: without relief, and with the best of each length.
Panel cusp_panel(const HarrisMapResult& map, const std::vector<std::string>& starts, Figure& figure) {
  FigureBlock cusp{"cusp", {"torque [N m]", "no relief [µm]"}, {}};
  Panel panel{.heading = "peak-to-peak transmission error, best relief of each length",
              .x = {.label = "Torque (N m)", .from_zero = true},
              .y = {.label = "Peak to peak (µm)", .from_zero = true},
              .curves = {{.block = "cusp", .colour = kBlack, .label = "no relief", .dash = 2}},
              .rules = {{.at = map.design_torque, .label = "design torque"}},
              .key = PanelKey::below};
  for (Index s = 0; s < map.length.size(); ++s) {
    const std::string label =
        text(rounded(map.optimum_relief[s] * kMicro, 2), " µm from ", starts[static_cast<size_t>(s)]);
    cusp.columns.push_back(label + " [µm]");
    panel.curves.push_back({.block = "cusp",
                            .y = static_cast<int>(s) + 3,
                            .colour = curve_colour(static_cast<size_t>(s)),
                            .label = label});
  }
  for (Index t = 0; t < map.torque.size(); ++t) {
    std::vector<double> row{map.torque[t], map.unrelieved[t] * kMicro};
    for (Index s = 0; s < map.length.size(); ++s) row.push_back(map.cusp(s, t) * kMicro);
    cusp.rows.push_back(row);
  }
  figure.blocks.push_back(std::move(cusp));
  return panel;
}

}  // namespace

Figure harris_map_figure(const HarrisMapResult& map) {
  Figure figure;
  Index best = 0;
  for (Index s = 1; s < map.length.size(); ++s)
    if (map.optimum_peak_to_peak[s] < map.optimum_peak_to_peak[best]) best = s;
  std::vector<std::string> starts;
  for (Index s = 0; s < map.length.size(); ++s)
    starts.push_back(rounded(map.start_roll(s, 0) * 180 / std::numbers::pi, 2) + "°");
  figure.title = text("Harris map: ", map.shape, " tip relief of ",
                      map.relieved == Relieved::both     ? "both gears"
                      : map.relieved == Relieved::driver ? "the driver"
                                                         : "the driven gear");
  figure.notes = {
      text("relief over ", rounded(map.length[best] * 1e3, 2), " mm of roll, from roll angle ",
           starts[static_cast<size_t>(best)], " of the driver; strips on a cached body, ",
           map.contact.positions, " mesh positions"),
      text("design torque ", map.design_torque, " N m on ", short_name(map.mesh.gear[0]), ", in mesh with ",
           short_name(map.mesh.gear[1]), ": ", rounded(map.optimum_relief[best] * kMicro, 2), " µm leave ",
           rounded(map.optimum_peak_to_peak[best] * kMicro, 3), " µm peak to peak")};
  plain_captions(figure.notes.size(), figure);
  const auto length = static_cast<size_t>(best);
  figure.blocks.push_back(map_block(map, length));
  figure.columns = 2;
  const MatrixRM& at_rest = map.peak_to_peak[length];
  figure.panels = {
      map_panel(map, at_rest, kPeakToPeak, "peak-to-peak transmission error", "Peak to peak (µm)", figure),
      cusp_panel(map, starts, figure)};
  FigureBlock ridge{"best relief", {"relief [µm]", "torque [N m]"}, {}};
  for (Index t = 0; t < map.torque.size(); ++t)
    ridge.rows.push_back({best_relief(map.relief, at_rest.row(t)) * kMicro, map.torque[t]});
  figure.blocks.push_back(std::move(ridge));
  figure.blocks.push_back(
      {"optimum",
       {"relief [µm]", "torque [N m]", "peak to peak [µm]"},
       {{map.optimum_relief[best] * kMicro, map.design_torque, map.optimum_peak_to_peak[best] * kMicro}}});
  std::vector<PanelCurve>& curves = figure.panels[0].curves;
  curves.push_back({.block = "best relief", .colour = kVermilion, .label = "best relief", .dash = 3});
  curves.push_back({.block = "optimum",
                    .style = PanelStyle::points,
                    .colour = kVermilion,
                    .label = "design torque",
                    .width = 2,
                    .mark = 3,
                    .size = 2.4});
  figure.panels[0].key = PanelKey::below;
  if (!map.dynamic_rms.empty())
    figure.panels.push_back(
        map_panel(map, map.dynamic_rms[length], kDynamicRms, "RMS at the worst speed", "RMS (µm)", figure));
  return figure;
}

}  // namespace whine
