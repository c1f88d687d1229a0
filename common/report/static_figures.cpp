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
#include "lumped/stiffness.h"
#include "report/figure_words.h"
#include "results/error_budget.h"
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

// Stems of the harmonics side by side, so that none hides another.
Panel harmonics_panel(const std::string& quantity, const std::string& block,
                      const std::vector<std::string>& labels) {
  Panel panel{.x = {.label = "Harmonic of the mesh frequency", .from = 0.4, .to = kShownHarmonics + 0.6},
              .y = {.label = quantity, .from_zero = true},
              .height = 560};
  for (size_t i = 0; i < labels.size(); ++i)
    panel.curves.push_back(
        {.block = block,
         .y = static_cast<int>(i) + 2,
         .style = PanelStyle::stems,
         .colour = static_cast<int>(i) + 1,
         .label = labels[i],
         .width = 1.6,
         .mark = kMarks[i],
         .size = 2,
         .shift = 0.15 * (static_cast<double>(i) - 0.5 * static_cast<double>(labels.size() - 1))});
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
  for (const auto& s : statics) labels.push_back(torque_label(s));
  figure.panels = {period_panel("Static transmission error (µm)", "transmission_error", labels),
                   harmonics_panel("Amplitude (µm)", "transmission_error harmonics", labels)};
  figure.columns = 2;
  return figure;
}

Figure mesh_stiffness_figure(const std::vector<StaticResult>& statics) {
  require_like_pairs(statics);
  const StaticResult& first = statics[0];
  const RectangularWave wave = rectangular_wave(first);
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
  figure.numbers = {{"curves", static_cast<double>(statics.size())}};
  std::string labels;
  for (const auto& s : statics)
    labels += text("'", torque_label(s), ", mean ", fixed(s.mean_stiffness * kMega, 1), "' ");
  figure.words = {{"labels", labels},
                  {"rectangle_label", "rectangular wave, mean " + fixed(wave.mean() * kMega, 1)}};
  return figure;
}

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
  std::string labels, alone;
  for (const auto& s : statics) {
    const auto one = ((s.tooth_load.array() > 0).cast<int>().rowwise().sum() == 1).count();
    const std::string percent = fixed(kPercent * static_cast<double>(one) / static_cast<double>(n), 0);
    labels += text("'", torque_label(s), ": one pair alone ", percent, " %' ");
    alone += text(alone.empty() ? "" : ", ", percent, " % at ", torque_label(s));
  }
  figure.notes.push_back(text("one pair alone carries the load for ", alone,
                              " of the mesh period; on the line of action alone it would for ",
                              fixed(kPercent * std::max(0.0, 2 - first.contact_ratio), 0), " %"));
  figure.blocks = {share, loads};
  const double pitch = pair.base_pitch();
  figure.numbers = {{"curves", static_cast<double>(statics.size())},
                    {"pairs", static_cast<double>(to - from + 1)},
                    {"first_pair", from},
                    {"path_start", pair.path_start() / pitch},
                    {"path_end", pair.path_end() / pitch},
                    {"static_force", first.torque / pair.gear(0).base_radius()}};
  figure.words = {{"labels", labels}, {"torque", torque_label(first)}};
  return figure;
}

namespace {

// The end of a logarithmic axis above all amplitudes, of a block, too: a power of ten; 1 if there are none.
double decade_above(double largest) {
  return largest > 0 ? std::pow(10, std::floor(std::log10(largest)) + 1) : 1;
}
double decade_above(const FigureBlock& block) {
  double largest = 0;
  for (const auto& row : block.rows) largest = std::max(largest, row[1]);
  return decade_above(largest);
}

}  // namespace

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
  r.dte_rms.maxCoeff(&peak);
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
  figure.blocks = {
      error,
      orders("at rest", s.transmission_error_order.size() - 1,
             [&](Eigen::Index k) { return s.transmission_error_order[k]; }),
      orders("in motion", r.dte_order.cols(), [&](Eigen::Index k) { return r.dte_order(peak, k - 1); })};
  figure.numbers = {{"periods", static_cast<double>(periods)},
                    {"last_order", kLastOrder},
                    {"top_at_rest", decade_above(figure.blocks[1])},
                    {"top_in_motion", decade_above(figure.blocks[2])}};
  figure.words = {{"speed", fixed(r.mesh_frequency[peak], 0) + " Hz"}};
  figure.height = 1300;
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
  std::vector<std::string> cracked;
  double stress_max = 0;  // MPa
  for (size_t k = 3; k < figure.blocks.size(); ++k) {
    cracked.push_back(figure.blocks[k].curve);
    for (const auto& row : figure.blocks[k].rows) stress_max = std::max(stress_max, row[1]);
  }
  figure.words = {{"labels", quoted_labels(cracked)}};
  figure.numbers = {{"around", kAround},
                    {"last_order", kLastOrder},
                    {"top", decade_above(orders)},
                    {"cracked_gears", static_cast<double>(cracked.size())},
                    {"stress_max", stress_max > 0 ? stress_max : 1},
                    {"notes", static_cast<double>(figure.notes.size())}};
  figure.height = 1300;
  return figure;
}

namespace {

// Root stress with elements of several sizes on the roots, and a note of what they change in all; no rows without it.
FigureBlock root_levels(const ErrorBudgetResult& budget, std::vector<std::string>& notes) {
  FigureBlock roots{"roots", {"element [mm]"}, {}, "roots", "largest root stress"};
  if (const RootConvergence root = convergence(budget.root); root.order.rows() > 0) {
    std::string words = "root stress with smaller elements on the roots:";
    for (int g = 0; g < kSides; ++g) {
      const Eigen::Index last = root.change.rows() - 1;
      const double order = resolved_order(root, last - 1, g);
      // What the finest still changes the result by, and the last order.
      words += text(g ? "; " : " ", budget.mesh.gear[g], " ",
                    shown((budget.root.stress(last + 1, g) / budget.root.stress(0, g) - 1) * kPercent, 2),
                    " % from ", shown(budget.root.element_size[0] * 1e3, 3), " to ",
                    shown(budget.root.element_size[last + 1] * 1e3, 3), " mm",
                    std::isfinite(order) ? ", order " + fixed(order, 1) : "");
      roots.columns.push_back(text("stress of ", budget.mesh.gear[g], " [MPa]"));
    }
    for (Eigen::Index k = 0; k < budget.root.stress.rows(); ++k)
      roots.rows.push_back({budget.root.element_size[k] * 1e3, budget.root.stress(k, 0) * 1e-6,
                            budget.root.stress(k, 1) * 1e-6});
    notes.push_back(words);
  }
  return roots;
}

}  // namespace

Figure error_budget_figure(const ErrorBudgetResult& budget) {
  Figure figure;
  figure.title = text("Error budget of the static transmission error, ", shown(budget.torque, 6), " N m");
  figure.notes.push_back(
      text("each discretisation alone twice as fine; sum of the changes of the mean stiffness ",
           shown(budget.refinement.mean_stiffness_change.cwiseAbs().sum() * kPercent, 3), " %"));
  figure.notes.push_back(text(
      "contact = ", budget.fidelity.contact, ", near field by ", budget.gear[0].discretisation.near_field,
      "; beyond the line what another choice changes, which is no error of this one"));
  const FigureBlock roots = root_levels(budget, figure.notes);
  double largest = 1;  // %
  for (const auto& [name, labels, count, changes] :
       {std::tuple{"changes", "labels", "entries", &budget.refinement},
        std::tuple{"choices", "choice_labels", "choices", &budget.choice}}) {
    FigureBlock block{name, {"entry [1]", "mean_stiffness [%]", "peak_to_peak [%]"}, {}, "", "", true};
    for (Eigen::Index n = 1; n <= changes->harmonic_change.cols(); ++n)
      block.columns.push_back(text("harmonic_", n, " [% of the first]"));
    const bool pressure = changes->pressure_change.size() > 0;
    if (pressure) block.columns.emplace_back("flank_pressure [%]");
    const bool stress = changes->root_stress_change.size() > 0;
    if (stress) block.columns.emplace_back("root_stress [%]");
    std::string words, rest = changes->entry;
    for (Eigen::Index i = 0; i < changes->mean_stiffness_change.size(); ++i) {
      std::vector<double> row{static_cast<double>(i), std::abs(changes->mean_stiffness_change[i]) * kPercent,
                              std::abs(changes->peak_to_peak_change[i]) * kPercent};
      for (Eigen::Index n = 0; n < changes->harmonic_change.cols(); ++n)
        row.push_back(std::abs(changes->harmonic_change(i, n)) * kPercent);
      if (pressure) row.push_back(std::abs(changes->pressure_change[i]) * kPercent);
      if (stress) row.push_back(std::abs(changes->root_stress_change[i]) * kPercent);
      block.rows.push_back(row);
      largest = std::max(largest, *std::max_element(row.begin() + 1, row.end()));
      const size_t comma = rest.find(", ");
      std::string label = rest.substr(0, comma);
      // The same numbers under the name of what is changed, and with their signs.
      FigureBlock named{text(name, " ", i), block.columns, {row}, "changes", label};
      named.columns[0] = "error [1 yes, 0 another choice]";
      named.rows[0][0] = changes == &budget.refinement ? 1 : 0;
      named.rows[0][1] = changes->mean_stiffness_change[i] * kPercent;
      named.rows[0][2] = changes->peak_to_peak_change[i] * kPercent;
      for (Eigen::Index n = 0; n < changes->harmonic_change.cols(); ++n)
        named.rows[0][static_cast<size_t>(3 + n)] = changes->harmonic_change(i, n) * kPercent;
      figure.blocks.push_back(named);
      // The values on a line of their own: '|' to the template.
      const size_t value = std::min(label.find(" at "), label.find_first_of("0123456789") - 1);
      if (value < label.size()) label[value] = '|';
      words += "'" + label + "' ";
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
    figure.blocks.push_back(block);
    figure.words.emplace_back(labels, words);
    figure.numbers.emplace_back(count, static_cast<double>(block.rows.size()));
    if (changes == &budget.refinement)
      figure.numbers.insert(figure.numbers.end(), {{"bars_each", 7 + (pressure ? 1 : 0) + (stress ? 1 : 0)},
                                                   {"pressure", pressure}});
  }
  if (!roots.rows.empty()) figure.blocks.push_back(roots);
  add_lines(figure.notes.size(), figure);
  figure.numbers.emplace_back("notes", static_cast<double>(figure.notes.size()));
  figure.numbers.emplace_back("top", decade_above(largest));
  return figure;
}

}  // namespace whine
