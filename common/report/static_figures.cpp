#include "report/period_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/error.h"
#include "gear/pair.h"
#include "report/figure_list.h"
#include "report/figure_words.h"

namespace whine {

using Eigen::Index;

FigureBlock period_block(const std::string& name, const std::vector<std::string>& columns,
                         const Eigen::VectorXd& phase, double end, const std::vector<PeriodCurve>& curves,
                         const std::string& table) {
  FigureBlock block{name, {"mesh_phase [1]"}, {}, table};
  block.columns.insert(block.columns.end(), columns.begin(), columns.end());
  const Index n = phase.size();
  for (Index i = 0; i <= n; ++i) {
    std::vector<double>& row = block.rows.emplace_back(1, i < n ? phase[i] : end);
    for (const PeriodCurve& curve : curves) row.push_back(curve.values[i < n ? i : 0]);
  }
  return block;
}

FigureBlock period_block(const std::string& quantity, const std::string& unit, const Eigen::VectorXd& phase,
                         double end, const std::vector<PeriodCurve>& curves, const std::string& table) {
  std::vector<std::string> columns;
  columns.reserve(curves.size());
  for (const PeriodCurve& curve : curves) columns.push_back(text(quantity, " ", curve.name, " [", unit, "]"));
  return period_block(quantity, columns, phase, end, curves, table);
}

FigureBlock spectrum_block(const std::string& quantity, const std::string& unit,
                           const std::vector<PeriodCurve>& curves, const std::string& table) {
  FigureBlock block{quantity + " harmonics", {"harmonic [1]"}, {}, table};
  Index last = kShownHarmonics;
  for (const PeriodCurve& curve : curves) {
    block.columns.push_back(text("amplitude ", curve.name, " [", unit, "]"));
    last = std::min(last, curve.amplitudes.size());
  }
  for (Index k = 0; k < last; ++k) {
    std::vector<double>& row = block.rows.emplace_back(1, static_cast<double>(k + 1));
    for (const PeriodCurve& curve : curves) row.push_back(curve.amplitudes[k]);
  }
  return block;
}

namespace {

// They stay in the order in which they are given, which is that of the scene.
void require_like_pairs(const std::vector<StaticResult>& statics) {
  if (statics.empty()) fail(Failure::input, "figure: no static.h5 given; 1 is the least");
  if (statics.size() > kMostCurves)
    fail(Failure::input, "figure: ", statics.size(), " static.h5 given; ", kMostCurves,
         " curves can be told apart");
  std::set<double> torques;
  for (size_t i = 0; i < statics.size(); ++i)
    if (!torques.insert(statics[i].torque).second)
      fail(Failure::input, "figure: two static.h5 of the same torque, ", statics[i].torque,
           " N m; give each once");
  for (const auto& s : statics) {
    if (s.hunting_periods > 1)
      fail(Failure::input, "figure: the teeth of ", s.torque,
           " N m differ from each other, and this figure shows one mesh period; make sidebands");
    if (s.mesh_phase.size() != statics[0].mesh_phase.size() || s.mesh_phase != statics[0].mesh_phase)
      fail(Failure::input, "figure: the static.h5 of ", s.torque, " N m and of ", statics[0].torque,
           " N m have different mesh phases; make them with the same `positions`");
  }
}

std::string torque_label(const StaticResult& s) {
  return torque_words(s.torque);
}

// One curve for each torque.
std::vector<PeriodCurve> curves_by_torque(const std::vector<StaticResult>& statics,
                                          Eigen::VectorXd StaticResult::*values,
                                          Eigen::VectorXd StaticResult::*harmonic, double factor) {
  require_like_pairs(statics);
  std::vector<PeriodCurve> out;
  for (const StaticResult& s : statics) {
    if ((s.*harmonic).size() < 2)
      fail(Failure::input, "figure: the static.h5 holds no harmonics; 1 is the least");
    out.push_back(
        {torque_label(s), (s.*values) * factor, (s.*harmonic).tail((s.*harmonic).size() - 1) * factor});
  }
  return out;
}

constexpr std::array kMarks{1, 6, 4, 2, 8, 12};  // + o square x triangle diamond

// A curve for each label over a mesh period.
Panel period_panel(const std::string& quantity, const std::string& block,
                   const std::vector<std::string>& labels) {
  Panel panel{.x = {.label = "Mesh phase (mesh periods, 0: pitch point)", .from = 0, .to = 1},
              .y = {.label = quantity},
              .key = PanelKey::none,
              .height = 560};
  constexpr std::array kDash{4, 3, 1, 1, 1, 1};
  for (size_t i = 0; i < labels.size(); ++i)
    panel.curves.push_back({.block = block,
                            .y = static_cast<int>(i) + 2,
                            .colour = static_cast<int>(i) + 1,
                            .label = labels[i],
                            .dash = kDash[i]});
  return panel;
}

// Stems of the harmonics side by side, so that none hides another; first: black ones of a block of its own, if it has a name.
Panel harmonics_panel(const std::string& quantity, const std::string& block,
                      const std::vector<std::string>& labels, const PanelCurve& first = {}) {
  Panel panel{.x = {.label = "Harmonic of the mesh frequency"},
              .y = {.label = quantity, .from_zero = true},
              .key = PanelKey::below,
              .height = 560};
  for (int k = 1; k <= kShownHarmonics; ++k) panel.x.names.push_back(std::to_string(k));
  if (!first.block.empty()) panel.curves.push_back(first);
  for (size_t i = 0; i < labels.size(); ++i)
    panel.curves.push_back({.block = block,
                            .y = static_cast<int>(i) + 2,
                            .style = PanelStyle::stems,
                            .colour = static_cast<int>(i) + 1,
                            .label = labels[i],
                            .width = 1.6,
                            .mark = kMarks[i],
                            .size = 2});
  const auto stems = static_cast<double>(panel.curves.size());
  for (size_t i = 0; i < panel.curves.size(); ++i)
    panel.curves[i].shift = std::min(0.15, 0.84 / stems) * (static_cast<double>(i) - 0.5 * (stems - 1));
  return panel;
}

double wrapped(double phase) {
  return phase - std::floor(phase);
}

}  // namespace

Figure transmission_error_figure(const std::vector<StaticResult>& statics) {
  const auto curves = curves_by_torque(statics, &StaticResult::transmission_error,
                                       &StaticResult::transmission_error_harmonic, kMicro);
  Figure figure;
  figure.title = "Static transmission error";
  figure.notes.push_back(pair_words(statics[0]));
  figure.blocks = {period_block("transmission_error", "µm", statics[0].mesh_phase, 1, curves),
                   spectrum_block("transmission_error", "µm", curves, "harmonics")};
  std::vector<std::string> labels;
  labels.reserve(curves.size());
  for (const PeriodCurve& curve : curves) labels.push_back(curve.name);
  figure.panels = {period_panel("Static transmission error (µm)", "transmission_error", labels),
                   harmonics_panel("Amplitude (µm)", "transmission_error harmonics", labels)};
  figure.columns = 2;
  return figure;
}

Figure mesh_stiffness_figure(const std::vector<StaticResult>& statics) {
  const auto curves =
      curves_by_torque(statics, &StaticResult::stiffness_secant, &StaticResult::stiffness_harmonic, kMega);
  const StaticResult& first = statics[0];
  const RectangularWave& wave = first.rectangular_wave;
  Figure figure;
  const bool bearings = first.mesh.bearing[0].elastic() || first.mesh.bearing[1].elastic();
  figure.title = text("Mesh stiffness: torque / (base radius × (static − unloaded transmission error",
                      bearings ? " − that of the bearings" : "", "))");
  figure.notes.push_back(pair_words(statics[0]));
  // Of a helical pair loads come and go along the face, and no lumped model takes such a wave.
  const bool waved = !first.gear[0].design.helical();
  if (waved)
    figure.notes.push_back(
        text("rectangular wave: levels at the middle of the zones of few and of many pairs at ",
             torque_label(first), ", steps where pairs come and go without load"));

  const std::string unit = "N/µm";
  FigureBlock rectangle{"rectangular wave", {"mesh_phase [1]", "mesh_stiffness [" + unit + "]"}, {}};
  std::vector<double> steps{wrapped(wave.high_begin), wrapped(wave.high_end)};
  std::sort(steps.begin(), steps.end());
  const double tiny = 1e-9;  // of a period: the two sides of a step
  rectangle.rows.push_back({0.0, wave.at(tiny) * kMega});
  for (double step : steps)
    for (double side : {-tiny, tiny}) rectangle.rows.push_back({step, wave.at(step + side) * kMega});
  rectangle.rows.push_back({1.0, wave.at(1.0 - tiny) * kMega});

  const FigureBlock spectrum = spectrum_block("mesh_stiffness", unit, curves, "harmonics");
  FigureBlock rectangle_spectrum{
      "rectangular wave harmonics", {"harmonic [1]", "amplitude [" + unit + "]"}, {}};
  for (const auto& row : spectrum.rows)
    rectangle_spectrum.rows.push_back({row[0], wave.amplitude(static_cast<int>(row[0])) * kMega});

  figure.blocks = {period_block("mesh_stiffness", unit, first.mesh_phase, 1, curves), spectrum};
  if (waved) figure.blocks = {figure.blocks[0], rectangle, spectrum, rectangle_spectrum};
  std::vector<std::string> labels;
  labels.reserve(statics.size());
  for (const auto& s : statics)
    labels.push_back(text(torque_label(s), ", mean ", fixed(s.mean_stiffness * kMega, 1)));
  const PanelCurve black{.block = "rectangular wave harmonics",
                         .style = PanelStyle::stems,
                         .colour = kBlack,
                         .label = "rectangular wave, mean " + fixed(wave.mean() * kMega, 1),
                         .width = 1.6,
                         .mark = 3,
                         .size = 2};
  figure.panels = {
      period_panel("Mesh stiffness (N/µm)", "mesh_stiffness", labels),
      harmonics_panel("Amplitude (N/µm)", "mesh_stiffness harmonics", labels, waved ? black : PanelCurve{})};
  std::vector<PanelCurve>& drawn = figure.panels[0].curves;
  if (waved) drawn.insert(drawn.begin(), {.block = rectangle.name, .colour = kBlack, .width = 3});
  figure.columns = 2;
  return figure;
}

namespace {

// Loads of the pairs from `from` to `to` over a mesh period.
Panel loads_panel(const StaticResult& first, int from, int to) {
  Panel each{.heading = torque_label(first),
             .x = {.label = "Mesh phase (mesh periods, 0: pitch point)", .from = 0, .to = 1},
             .y = {.label = "Load (N)", .from_zero = true},
             .key = PanelKey::below};
  each.curves.push_back({.block = "loads", .colour = kDark, .label = "all pairs", .width = 1.8, .dash = 4});
  for (int j = from; j <= to; ++j)
    each.curves.push_back({.block = "loads",
                           .y = 3 + j - from,
                           .colour = (3 + j - from) % 6 + 1,
                           .label = j == 0 ? "reference pair"
                                           : text(j > 0 ? "preceding pair" : "following pair",
                                                  std::abs(j) > 1 ? text(" ", std::abs(j)) : ""),
                           .width = 2.6});
  each.rules = {rest_rule(first.gear[0].design, first.torque)};
  return each;
}

// What share a pair of teeth carries over its way through the mesh, of the block "share"; how long one carries alone goes to the notes.
Panel shares_panel(const std::vector<StaticResult>& statics, std::vector<std::string>& notes) {
  const StaticResult& first = statics[0];
  const GearPair pair(first);
  // Half of the overlap, by which a contact line reaches beyond the middle of the face.
  const double pitch = pair.base_pitch(), overlap = 0.5 * pair.overlap_ratio(),
               path_start = pair.path_start() / pitch - overlap, path_end = pair.path_end() / pitch + overlap;
  Panel shares{.x = {.label = "Phase of the pair (mesh periods, 0: pitch point)",
                     .from = path_start - 0.35,
                     .to = path_end + 0.35},
               .y = {.label = "Share of the load (%)", .from = 0, .to = 104},
               .key = PanelKey::below,
               .height = 540};
  std::string alone;
  for (size_t i = 0; i < statics.size(); ++i) {
    const auto one = ((statics[i].tooth_load.array() > 0).cast<int>().rowwise().sum() == 1).count();
    const std::string percent =
        fixed(kPercent * static_cast<double>(one) / static_cast<double>(first.mesh_phase.size()), 0);
    // Curves lie on each other over much of the path: what is drawn first shows on either side of what is drawn on it.
    shares.curves.push_back({.block = "share",
                             .y = static_cast<int>(i) + 2,
                             .colour = static_cast<int>(i) + 1,
                             .label = text(torque_label(statics[i]), ": one pair alone ", percent, " %"),
                             .width = 1.8 + 1.1 * static_cast<double>(statics.size() - 1 - i)});
    alone += text(alone.empty() ? "" : ", ", percent, " % at ", torque_label(statics[i]));
  }
  // On the line of action: first and last contact, and between them the part with one pair alone, of helical pairs that with a line over
  // the whole face.
  for (const double end : {path_start, path_end}) shares.rules.push_back({'x', end, "", kDark});
  const double whole = overlap > 0 ? 2 * overlap : 1;
  if (overlap == 0 || path_end - path_start > 2 * whole)
    for (const double end : overlap > 0 ? std::array{path_start + whole, path_end - whole}
                                        : std::array{path_end - 1, path_start + 1})
      shares.rules.push_back({'x', end, "", kGrey});
  notes.push_back(text("one pair alone carries the load for ", alone,
                       " of the mesh period; on the line of action alone it would for ",
                       fixed(kPercent * std::max(0.0, 2 - first.contact_ratio - 2 * overlap), 0), " %"));
  return shares;
}

}  // namespace

// What a pair of teeth carries on its way through the mesh. Pair j is j places ahead of the reference pair: at mesh phase f it
// is at phase f + j of its own.
Figure load_sharing_figure(const std::vector<StaticResult>& statics) {
  require_like_pairs(statics);
  const StaticResult& first = statics[0];
  const Index n = first.mesh_phase.size();
  // Pairs that carry load at any torque.
  int from = 0, to = 0;
  for (const auto& s : statics)
    for (Index c = 0; c < s.pair.size(); ++c)
      if (s.tooth_load.col(c).maxCoeff() > 0) {
        from = std::min(from, s.pair[c]);
        to = std::max(to, s.pair[c]);
      }
  const auto load = [](const StaticResult& s, Index i, int j) {
    const auto found = std::find(s.pair.begin(), s.pair.end(), j);
    return found == s.pair.end() ? 0.0 : s.tooth_load(i, found - s.pair.begin());
  };

  Figure figure;
  figure.title = "Load sharing of the tooth pairs at rest";
  figure.notes.push_back(pair_words(first));
  FigureBlock share{"share", {"phase of the pair [1]"}, {}};
  FigureBlock loads{"loads", {"mesh_phase [1]", "all pairs [N]"}, {}};
  for (const auto& s : statics) share.columns.push_back(text("share of the load ", torque_label(s), " [%]"));
  for (int j = from; j <= to; ++j) {
    loads.columns.push_back(text("pair ", j, " [N]"));
    for (Index i = 0; i < n; ++i) {
      std::vector<double> row{first.mesh_phase[i] + j};
      for (const auto& s : statics) row.push_back(load(s, i, j) / s.tooth_load.row(i).sum() * kPercent);
      share.rows.push_back(row);
    }
  }
  const auto carries = [](const std::vector<double>& row) {
    return std::any_of(row.begin() + 1, row.end(), [](double percent) { return percent > 0; });
  };
  // With a position without load on either side.
  const auto begin = std::find_if(share.rows.begin(), share.rows.end(), carries);
  const auto end = std::find_if(share.rows.rbegin(), share.rows.rend(), carries).base();
  share.rows = std::vector<std::vector<double>>(begin == share.rows.begin() ? begin : begin - 1,
                                                end == share.rows.end() ? end : end + 1);
  for (Index i = 0; i <= n; ++i) {
    std::vector<double> row{i < n ? first.mesh_phase[i] : 1.0, first.tooth_load.row(i % n).sum()};
    // At phase 1 every pair has taken the place of the one ahead.
    for (int j = from; j <= to; ++j) row.push_back(i < n ? load(first, i, j) : load(first, 0, j + 1));
    loads.rows.push_back(row);
  }
  figure.blocks = {share, loads};
  figure.panels = {shares_panel(statics, figure.notes), loads_panel(first, from, to)};
  figure.columns = 2;
  return figure;
}

}  // namespace whine
