#include "report/static_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/units.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "results/impact.h"
#include "results/response.h"
#include "signal/spectrum.h"

namespace whine {
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

// One column per curve, first column the phase; the first point again at phase 1, so that the period closes.
FigureBlock period_block(const std::vector<StaticResult>& statics, const std::string& quantity,
                         const std::string& unit, Eigen::VectorXd StaticResult::*curve, double factor) {
  FigureBlock block{quantity, {"mesh_phase [1]"}, {}};
  for (const auto& s : statics)
    block.columns.push_back(text(quantity, " ", torque_label(s), " [", unit, "]"));
  const Eigen::Index n = statics[0].mesh_phase.size();
  for (Eigen::Index i = 0; i <= n; ++i) {
    std::vector<double> row{i < n ? statics[0].mesh_phase[i] : 1.0};
    for (const auto& s : statics) row.push_back((s.*curve)[i < n ? i : 0] * factor);
    block.rows.push_back(row);
  }
  return block;
}

FigureBlock spectrum_block(const std::vector<StaticResult>& statics, const std::string& quantity,
                           const std::string& unit, Eigen::VectorXd StaticResult::*harmonic, double factor) {
  FigureBlock block{quantity + " harmonics", {"harmonic [1]"}, {}, "harmonics"};
  Eigen::Index last = kShownHarmonics;
  for (const auto& s : statics) {
    block.columns.push_back(text("amplitude ", torque_label(s), " [", unit, "]"));
    last = std::min(last, (s.*harmonic).size() - 1);
  }
  if (last < 1) fail(Failure::input, "figure: the static.h5 holds no harmonics; 1 is the least");
  for (Eigen::Index k = 1; k <= last; ++k) {
    std::vector<double> row{static_cast<double>(k)};
    for (const auto& s : statics) row.push_back((s.*harmonic)[k] * factor);
    block.rows.push_back(row);
  }
  return block;
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
  require_like_pairs(statics);
  Figure figure;
  figure.title = "Static transmission error";
  figure.notes.push_back(pair_words(statics[0]));
  figure.blocks.push_back(
      period_block(statics, "transmission_error", "µm", &StaticResult::transmission_error, kMicro));
  figure.blocks.push_back(spectrum_block(statics, "transmission_error", "µm",
                                         &StaticResult::transmission_error_harmonic, kMicro));
  std::vector<std::string> labels;
  labels.reserve(statics.size());
  for (const auto& s : statics) labels.push_back(torque_label(s));
  figure.panels = {period_panel("Static transmission error (µm)", "transmission_error", labels),
                   harmonics_panel("Amplitude (µm)", "transmission_error harmonics", labels)};
  figure.columns = 2;
  return figure;
}

Figure mesh_stiffness_figure(const std::vector<StaticResult>& statics) {
  require_like_pairs(statics);
  const StaticResult& first = statics[0];
  const RectangularWave& wave = first.rectangular_wave;
  Figure figure;
  const bool bearings = first.mesh.bearing[0].elastic() || first.mesh.bearing[1].elastic();
  figure.title = text("Mesh stiffness: torque / (base radius × (static − unloaded transmission error",
                      bearings ? " − that of the bearings" : "", "))");
  figure.notes.push_back(pair_words(statics[0]));
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

  FigureBlock spectrum =
      spectrum_block(statics, "mesh_stiffness", unit, &StaticResult::stiffness_harmonic, kMega);
  FigureBlock rectangle_spectrum{
      "rectangular wave harmonics", {"harmonic [1]", "amplitude [" + unit + "]"}, {}};
  for (const auto& row : spectrum.rows)
    rectangle_spectrum.rows.push_back({row[0], wave.amplitude(static_cast<int>(row[0])) * kMega});

  figure.blocks = {period_block(statics, "mesh_stiffness", unit, &StaticResult::stiffness_secant, kMega),
                   rectangle, spectrum, rectangle_spectrum};
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
  figure.panels = {period_panel("Mesh stiffness (N/µm)", "mesh_stiffness", labels),
                   harmonics_panel("Amplitude (N/µm)", "mesh_stiffness harmonics", labels, black)};
  auto& curves = figure.panels[0].curves;
  curves.insert(curves.begin(), {.block = rectangle.name, .colour = kBlack, .width = 3});
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
  each.rules = {rest_rule(first.torque / ToothGeometry(first.gear[0].design).base_radius())};
  return each;
}

}  // namespace

// What a pair of teeth carries on its way through the mesh. Pair j is j places ahead of the reference pair: at mesh phase f it
// is at phase f + j of its own.
Figure load_sharing_figure(const std::vector<StaticResult>& statics) {
  require_like_pairs(statics);
  const StaticResult& first = statics[0];
  const GearPair pair(first);
  const Eigen::Index n = first.mesh_phase.size();
  // Pairs that carry load at any torque.
  int from = 0, to = 0;
  for (const auto& s : statics)
    for (Eigen::Index c = 0; c < s.pair.size(); ++c)
      if (s.tooth_load.col(c).maxCoeff() > 0) {
        from = std::min(from, s.pair[c]);
        to = std::max(to, s.pair[c]);
      }
  const auto load = [](const StaticResult& s, Eigen::Index i, int j) {
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
    for (Eigen::Index i = 0; i < n; ++i) {
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
  for (Eigen::Index i = 0; i <= n; ++i) {
    std::vector<double> row{i < n ? first.mesh_phase[i] : 1.0, first.tooth_load.row(i % n).sum()};
    // At phase 1 every pair has taken the place of the one ahead.
    for (int j = from; j <= to; ++j) row.push_back(i < n ? load(first, i, j) : load(first, 0, j + 1));
    loads.rows.push_back(row);
  }
  const double pitch = pair.base_pitch(), path_start = pair.path_start() / pitch,
               path_end = pair.path_end() / pitch;
  Panel shares{.x = {.label = "Phase of the pair (mesh periods, 0: pitch point)",
                     .from = path_start - 0.35,
                     .to = path_end + 0.35},
               .y = {.label = "Share of the load (%)", .from = 0, .to = 104},
               .key = PanelKey::below,
               .height = 540};
  std::string alone;
  for (size_t i = 0; i < statics.size(); ++i) {
    const auto one = ((statics[i].tooth_load.array() > 0).cast<int>().rowwise().sum() == 1).count();
    const std::string percent = fixed(kPercent * static_cast<double>(one) / static_cast<double>(n), 0);
    // Curves lie on each other over much of the path: what is drawn first shows on either side of what is drawn on it.
    shares.curves.push_back({.block = "share",
                             .y = static_cast<int>(i) + 2,
                             .colour = static_cast<int>(i) + 1,
                             .label = text(torque_label(statics[i]), ": one pair alone ", percent, " %"),
                             .width = 1.8 + 1.1 * static_cast<double>(statics.size() - 1 - i)});
    alone += text(alone.empty() ? "" : ", ", percent, " % at ", torque_label(statics[i]));
  }
  // On the line of action: first and last contact, and between them the part with one pair alone.
  for (const double end : {path_start, path_end}) shares.rules.push_back({'x', end, "", kDark});
  for (const double end : {path_end - 1, path_start + 1}) shares.rules.push_back({'x', end, "", kGrey});
  figure.notes.push_back(text("one pair alone carries the load for ", alone,
                              " of the mesh period; on the line of action alone it would for ",
                              fixed(kPercent * std::max(0.0, 2 - first.contact_ratio), 0), " %"));
  figure.blocks = {share, loads};
  figure.panels = {shares, loads_panel(first, from, to)};
  figure.columns = 2;
  return figure;
}

Figure sidebands_figure(const StaticResult& s, const ResponseResult& r) {
  const int periods = s.hunting_periods;
  if (periods < 2)
    fail(
        Failure::input,
        "figure: the teeth are all alike and have no sidebands; give a gear of the scene a section [gear.<name>.error]");
  if (r.hunting_periods != periods || r.torque != s.torque)
    fail(Failure::input, "figure: the sweep is of ", r.hunting_periods, " mesh periods at ", r.torque,
         " N m, the statics are of ", periods, " at ", s.torque, " N m; give those of one scene and torque");
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;  // m: below, nothing but round-off
  Eigen::Index peak = 0;
  r.dte_rms.col(0).maxCoeff(&peak);
  Figure figure;
  figure.title = "Sidebands of teeth that differ";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(
      "the same teeth meet after ", periods, " mesh periods; orders of the mesh frequency, of the shafts ",
      shown(1.0 / s.gear[0].design.teeth, 4), " (driver) and ", shown(1.0 / s.gear[1].design.teeth, 4)));
  FigureBlock error{"transmission_error", {"mesh_phase [1]", "transmission_error [µm]"}, {}};
  for (Eigen::Index i = 0; i < s.mesh_phase.size(); ++i)
    error.rows.push_back({s.mesh_phase[i], s.transmission_error[i] * kMicro});
  const auto orders = [&](const std::string& name, Eigen::Index count, const auto& amplitude) {
    FigureBlock block{"orders " + name, {"order [1]", "amplitude [µm]"}, {}, "orders", name};
    for (Eigen::Index k = 1; k <= count && k <= kLastOrder * periods; ++k)
      block.rows.push_back({static_cast<double>(k) / periods, std::max(kFloor, amplitude(k)) * kMicro});
    return block;
  };
  figure.blocks = {error,
                   orders("at rest", s.transmission_error_order.size() - 1,
                          [&](Eigen::Index k) { return s.transmission_error_order[k]; }),
                   orders("in motion", r.dte_order[static_cast<size_t>(peak)].rows(),
                          [&](Eigen::Index k) { return r.dte_order[static_cast<size_t>(peak)](k - 1, 0); })};
  figure.panels = {{.x = {.label = "Mesh periods", .from = 0, .to = static_cast<double>(periods)},
                    .y = {.label = "Static transmission error (µm)"},
                    .curves = {{.block = "transmission_error", .width = 1.4}},
                    .height = 230}};
  for (const auto& [name, heading] :
       {std::pair{"orders at rest", std::string("at rest")},
        std::pair{"orders in motion", "in motion at " + fixed(r.mesh_frequency[peak], 0) + " Hz"}})
    figure.panels.push_back({.heading = heading,
                             .x = {.label = "Order of the mesh frequency", .from = 0, .to = kLastOrder},
                             .y = {.label = "Amplitude (µm)", .log = true},
                             .curves = {{.block = name,
                                         .style = PanelStyle::stems,
                                         .colour = heading == "at rest" ? kBlue : kVermilion,
                                         .width = 1.8,
                                         .size = 0}},
                             .height = 230});
  return figure;
}

namespace {

// Largest root stress of each tooth of a cracked gear while it is in mesh, about the cracked one; an intact tooth is the farthest
// from it. Nothing of a result without root stress.
void add_root_stress_of_teeth(const StaticResult& s, int g, int around, Figure& figure) {
  const MatrixRM& stress = s.root_stress[static_cast<size_t>(g)];
  const GearDesign& design = s.gear[static_cast<size_t>(g)].design;
  if (stress.size() == 0 || design.crack.depth == 0) return;
  const Eigen::Index positions = s.mesh_phase.size() / s.hunting_periods;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(design.teeth);
  for (Eigen::Index i = 0; i < stress.rows(); ++i)
    for (Eigen::Index k = 0; k < stress.cols(); ++k) {
      if (!(s.tooth_load(i, k) > 0)) continue;
      // Pairs count in the sense of motion, teeth counter-clockwise, which is that of the driver.
      const int pair = s.pair[k] - static_cast<int>(i / positions), tooth = g == 0 ? pair : -pair;
      double& most = largest[((tooth % design.teeth) + design.teeth) % design.teeth];
      most = std::max(most, stress(i, k));
    }
  const auto of = [&](int from_crack) {
    return largest[((design.crack.tooth + from_crack) % design.teeth + design.teeth) % design.teeth];
  };
  const double intact = of(design.teeth / 2);
  const std::string of_gear = s.mesh.gear[static_cast<size_t>(g)];
  FigureBlock teeth{
      text("teeth ", figure.blocks.size() - 2),
      {"tooth from the cracked one [1]", "largest root stress [MPa]", "of an intact tooth [MPa]"},
      {},
      "teeth",
      of_gear};
  for (int k = -around; k <= around; ++k)
    teeth.rows.push_back({static_cast<double>(k), of(k) * kInMegapascals, intact * kInMegapascals});
  figure.blocks.push_back(teeth);
  figure.notes.push_back(text(
      "largest root stress of ", without_markup(of_gear), " ", shown(largest.maxCoeff() * kInMegapascals, 4),
      " MPa, ", shown(100 * (largest.maxCoeff() / intact - 1), 2),
      " % above that of an intact tooth; beside the slit ", shown(of(0) * kInMegapascals, 4),
      " MPa, not counting its tip, where stress is singular"));
}

// The fourth block and those behind it are root stresses of the teeth of a gear.
std::vector<Panel> crack_panels(const std::vector<FigureBlock>& blocks, double around, double last_order) {
  const PanelCurve with{.colour = kVermilion, .label = "with the crack", .width = 1.8, .size = 0},
      without{.colour = kDark, .label = "without", .width = 1.6, .dash = 3, .mark = 6};
  const PanelAxis periods{
      .label = "Mesh periods from the one with the largest mark", .from = -around, .to = around + 1};
  const auto of = [](PanelCurve curve, const char* block, int y, PanelStyle style = PanelStyle::line) {
    curve.block = block;
    curve.y = y;
    curve.style = style;
    return curve;
  };
  std::vector<Panel> panels{
      {.heading = "static transmission error",
       .x = periods,
       .y = {.label = "Error (µm)"},
       .curves = {of(without, "transmission_error", 3), of(with, "transmission_error", 2)}},
      {.heading = "what the crack adds",
       .x = periods,
       .y = {.label = "Added (µm)"},
       .curves = {of(with, "transmission_error", 4)},
       .key = PanelKey::none},
      {.heading = "orders of the mesh frequency",
       .x = {.label = "Order", .from = 0, .to = last_order},
       .y = {.label = "Amplitude (µm)", .log = true},
       .curves = {of(with, "orders", 2, PanelStyle::stems),
                  of(without, "orders without", 2, PanelStyle::points)}}};
  Panel stress{.heading = "largest root stress of each tooth about the cracked one",
               .x = {.label = "Tooth, counter-clockwise from the cracked one",
                     .from = -around - 0.5,
                     .to = around + 0.5},
               .y = {.label = "Stress (MPa)", .from_zero = true}};
  for (size_t k = 3; k < blocks.size(); ++k) {
    stress.curves.push_back({.block = blocks[k].name,
                             .y = 3,
                             .colour = kDark,
                             .label = k > 3 ? "" : "intact tooth",
                             .width = 1.6,
                             .dash = 3});
    stress.curves.push_back({.block = blocks[k].name,
                             .style = PanelStyle::points,
                             .colour = curve_colour(k - 3),
                             .label = without_markup(short_name(blocks[k].curve)),
                             .size = 1.6});
  }
  if (!stress.curves.empty()) panels.push_back(stress);
  for (Panel& panel : panels) panel.height = 180;
  return panels;
}

}  // namespace

Figure crack_figure(const StaticResult& s) {
  std::string cracks;
  for (size_t g = 0; g < kSides; ++g)
    if (const Crack& crack = s.gear[g].design.crack; crack.depth > 0)
      cracks += text(cracks.empty() ? "" : "; ", "tooth ", crack.tooth, " of the ", kGearName[g],
                     ": a slit of ", shown(crack.depth * 1e3, 4), " mm from the fillet, ",
                     shown(crack.angle * 180 / std::numbers::pi, 4), "° to the tooth's centre line");
  if (cracks.empty())
    fail(Failure::input,
         "figure: no tooth has a crack; give a gear of the scene a section [gear.<name>.crack]");
  for (const ToothErrors& errors : s.mesh.errors)
    if (!errors.none())
      fail(
          Failure::input,
          "figure: teeth have errors of their own beside the crack; use a scene without [gear.<name>.error]");
  const Eigen::Index positions = s.mesh_phase.size() / s.hunting_periods;
  const auto period = [&](Eigen::Index k) { return s.transmission_error.segment(k * positions, positions); };
  Eigen::Index stiffest = 0, most = 0;
  double largest = 0;
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (period(k).mean() < period(stiffest).mean()) stiffest = k;
  const Eigen::VectorXd intact = period(stiffest);
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (const double here = (period(k) - intact).maxCoeff(); here > largest) {
      largest = here;
      most = k;
    }
  constexpr int kAround = 5;  // mesh periods either side
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;
  Figure figure;
  figure.title = "A cracked tooth: static transmission error and root stress";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(cracks, "; adds up to ", shown(largest * kMicro, 3), " µm, ",
                              shown(100 * largest / intact.mean(), 3), " % of the mean"));
  FigureBlock error{"transmission_error",
                    {"mesh periods [1]", "with the crack [µm]", "without [µm]", "difference [µm]"},
                    {}};
  for (Eigen::Index k = -kAround; k <= kAround; ++k) {
    const Eigen::Index at = ((most + k) % s.hunting_periods + s.hunting_periods) % s.hunting_periods;
    for (Eigen::Index i = 0; i < positions; ++i)
      error.rows.push_back({static_cast<double>(k) + static_cast<double>(i) / static_cast<double>(positions),
                            period(at)[i] * kMicro, intact[i] * kMicro,
                            (period(at)[i] - intact[i]) * kMicro});
  }
  FigureBlock orders{"orders", {"order [1]", "amplitude [µm]"}, {}, "orders", "with the crack"};
  for (Eigen::Index k = 1; k < s.transmission_error_order.size() && k <= kLastOrder * s.hunting_periods; ++k)
    orders.rows.push_back({static_cast<double>(k) / s.hunting_periods,
                           std::max(kFloor, s.transmission_error_order[k]) * kMicro});
  FigureBlock without{"orders without", {"order [1]", "amplitude [µm]"}, {}, "orders", "without"};
  const Harmonics of_intact = harmonics(intact, static_cast<int>(kLastOrder));
  for (Eigen::Index k = 0; k < of_intact.amplitude.size(); ++k)
    without.rows.push_back({static_cast<double>(k + 1), of_intact.amplitude[k] * kMicro});
  figure.blocks = {error, orders, without};
  for (int g = 0; g < kSides; ++g) add_root_stress_of_teeth(s, g, kAround, figure);
  figure.panels = crack_panels(figure.blocks, kAround, kLastOrder);
  return figure;
}

}  // namespace whine
