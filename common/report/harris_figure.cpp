#include "report/figure_list.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "report/figure_words.h"

namespace whine {

using Eigen::Index;

namespace {

// The relief at which lines through the values on either side of the least one meet, as in a cusp: on the grid of the map the
// best relief would go in steps, and about its least value a map is flat. Beside an end of the grid, where torques are small and
// the flat is narrow, the lines are of the places that are there. That of the least value where they do not meet near it.
// Where a relief hardly helps, as one that is too short, values are within kAlike of the least one over many places, and which of
// them is least is chance: the middle of that range then.
double best_relief(const Eigen::VectorXd& relief, const Eigen::RowVectorXd& value) {
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

}  // namespace

Figure harris_map_figure(const HarrisMapResult& map) {
  Figure figure;
  Index best = 0;
  for (Index s = 1; s < map.length.size(); ++s)
    if (map.optimum_peak_to_peak[s] < map.optimum_peak_to_peak[best]) best = s;
  const auto start_words = [&](Index s) {
    return rounded(map.start_roll(s, 0) * 180 / std::numbers::pi, 2) + "°";
  };
  figure.title = text("Harris map: ", map.shape, " tip relief of ",
                      map.relieved == Relieved::both     ? "both gears"
                      : map.relieved == Relieved::driver ? "the driver"
                                                         : "the driven gear");
  figure.notes.push_back(text(
      "relief over ", rounded(map.length[best] * 1e3, 2), " mm of roll, from roll angle ", start_words(best),
      " of the driver; strips on a cached body, ", map.contact.positions, " mesh positions"));
  figure.notes.push_back(text("design torque ", map.design_torque, " N m on ", short_name(map.mesh.gear[0]),
                              ", in mesh with ", short_name(map.mesh.gear[1]), ": ",
                              rounded(map.optimum_relief[best] * kMicro, 2), " µm leave ",
                              rounded(map.optimum_peak_to_peak[best] * kMicro, 3), " µm peak to peak"));
  plain_captions(figure.notes.size(), figure);
  const auto cube = [&](const std::string& name, const MatrixRM& values, double scale) {
    FigureBlock block{name, {"relief [µm]", "torque [N m]", "value"}, {}, "", "", true};
    for (Index t = 0; t < map.torque.size(); ++t) {
      if (t > 0) block.rows.push_back({});
      for (Index r = 0; r < map.relief.size(); ++r)
        block.rows.push_back({map.relief[r] * kMicro, map.torque[t], values(t, r) * scale});
    }
    figure.blocks.push_back(block);
  };
  FigureBlock whole{"map", {"relief [µm]", "torque [N m]", "peak to peak [µm]"}, {}};
  for (int n = 0; n < 3; ++n) whole.columns.push_back(text("harmonic ", n + 1, " [µm]"));
  if (!map.dynamic_rms.empty())
    whole.columns.insert(whole.columns.end(), {"dte_rms [µm]", "at mesh_frequency [Hz]"});
  for (Index t = 0; t < map.torque.size(); ++t)
    for (Index r = 0; r < map.relief.size(); ++r) {
      std::vector<double> row{map.relief[r] * kMicro, map.torque[t], map.peak_to_peak[best](t, r) * kMicro};
      for (int n = 0; n < 3; ++n) row.push_back(map.harmonic[n][best](t, r) * kMicro);
      if (!map.dynamic_rms.empty())
        row.insert(row.end(), {map.dynamic_rms[best](t, r) * kMicro, map.worst_frequency[best](t, r)});
      whole.rows.push_back(row);
    }
  figure.blocks.push_back(whole);
  cube("peak to peak", map.peak_to_peak[best], kMicro);
  for (int n = 0; n < 3; ++n) cube(text("harmonic ", n + 1), map.harmonic[n][best], kMicro);
  FigureBlock ridge{"best relief", {"relief [µm]", "torque [N m]"}, {}};
  for (Index t = 0; t < map.torque.size(); ++t) {
    ridge.rows.push_back({best_relief(map.relief, map.peak_to_peak[best].row(t)) * kMicro, map.torque[t]});
  }
  figure.blocks.push_back(ridge);
  figure.blocks.push_back(
      {"optimum",
       {"relief [µm]", "torque [N m]", "peak to peak [µm]"},
       {{map.optimum_relief[best] * kMicro, map.design_torque, map.optimum_peak_to_peak[best] * kMicro}}});
  FigureBlock cusp{"cusp", {"torque [N m]", "no relief [µm]"}, {}};
  std::string labels = "'no relief' ";
  for (Index s = 0; s < map.length.size(); ++s) {
    const std::string label = text(rounded(map.optimum_relief[s] * kMicro, 2), " µm from ", start_words(s));
    labels += "'" + label + "' ";
    cusp.columns.push_back(label + " [µm]");
  }
  for (Index t = 0; t < map.torque.size(); ++t) {
    std::vector<double> row{map.torque[t], map.unrelieved[t] * kMicro};
    for (Index s = 0; s < map.length.size(); ++s) row.push_back(map.cusp(s, t) * kMicro);
    cusp.rows.push_back(row);
  }
  figure.blocks.push_back(cusp);
  figure.words.emplace_back("labels", labels);
  figure.numbers.emplace_back("curves", static_cast<double>(map.length.size() + 1));
  figure.numbers.emplace_back("design_torque", map.design_torque);
  figure.numbers.emplace_back("largest", map.peak_to_peak[best].maxCoeff() * kMicro);
  figure.numbers.emplace_back("moving", map.dynamic_rms.empty() ? 0 : 1);
  if (!map.dynamic_rms.empty()) {
    cube("rms", map.dynamic_rms[best], kMicro);
    cube("worst frequency", map.worst_frequency[best], 1);
    figure.height = 1900;
  }
  return figure;
}

}  // namespace whine
