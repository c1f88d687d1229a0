#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/layout.h"
#include "report/alike_meshes.h"
#include "report/distinct_curves.h"
#include "report/figure_list.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "report/period_curves.h"
#include "report/system_picture.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Over the mesh period, or over the hunting period of teeth that differ or the periods of a motion.
PanelAxis phase_axis(int periods) {
  return {.label = "Mesh phase (mesh periods)", .from = 0, .to = static_cast<double>(periods)};
}

// Curve i of those with these numbers among the distinct ones. Where some are near each other for a while, what is drawn first shows on
// either side of what is drawn on it.
PanelCurve numbered_curve(const std::string& block, size_t i, const std::vector<size_t>& numbers,
                          bool dense) {
  const size_t n = numbers[i];
  return {.block = block,
          .y = static_cast<int>(i) + 2,
          .colour = curve_colour(n),
          .width = dense ? 1.2 : 2 + 0.8 * static_cast<double>(count_of_distinct(numbers) - 1 - n),
          .dash = n < 6 ? 1 : 3};
}

void note_alike(const std::vector<size_t>& numbers, Figure& figure) {
  if (count_of_distinct(numbers) < numbers.size() &&
      std::find(figure.notes.begin(), figure.notes.end(), kOneColour) == figure.notes.end())
    figure.notes.emplace_back(kOneColour);
}

// By both panels of a row.
std::vector<size_t> distinct_of(const std::vector<PeriodCurve>& curves, double span, double most) {
  std::vector<Eigen::VectorXd> both;
  both.reserve(curves.size());
  for (const PeriodCurve& curve : curves) {
    both.emplace_back(curve.values.size() + curve.amplitudes.size());
    both.back() << curve.values / std::max(span, 1e-12), curve.amplitudes / std::max(most, 1e-12);
  }
  return distinct_curves(both, 1);
}

// Phases at which the curves of a figure are given, of the mesh periods after which they repeat.
struct Phases {
  Eigen::VectorXd phase;
  int periods = 1;
};

// One row of the figure: curves over these periods, and their harmonics of the mesh frequency.
void add_row(const Phases& of, const std::string& quantity, const std::string& axis,
             const std::string& short_axis, const std::string& unit, std::vector<PeriodCurve> curves,
             Figure& figure) {
  if (curves.size() > kMostLines) {
    figure.notes.push_back(text(axis, ": the first ", kMostLines, " of ", curves.size(), " curves"));
    curves.resize(kMostLines);
  }
  const int count = resolved_harmonics(of.phase.size(), kShownHarmonics, of.periods);
  double low = curves[0].values.minCoeff(), high = curves[0].values.maxCoeff(), most = 0;
  for (PeriodCurve& curve : curves) {
    curve.amplitudes = harmonics(curve.values, count, of.periods).amplitude;
    low = std::min(low, curve.values.minCoeff());
    high = std::max(high, curve.values.maxCoeff());
    if (count > 0) most = std::max(most, curve.amplitudes.maxCoeff());
  }
  const FigureBlock period = period_block(quantity, unit, of.phase, of.periods, curves, "period " + quantity),
                    spectrum = spectrum_block(quantity, unit, curves, "harmonics " + quantity);
  figure.blocks.push_back(period);
  figure.blocks.push_back(spectrum);
  // Curves that are constant but for round-off are drawn as a line, not as their noise.
  const double size = std::max({std::abs(low), std::abs(high), 1e-12}),
               room = std::max(0.06 * (high - low), 1e-3 * size);
  Panel over_period{.heading = axis,
                    .x = phase_axis(of.periods),
                    .y = {.label = text(short_axis, " (", unit, ")"), .from = low - room, .to = high + room},
                    .key = PanelKey::none},
      harmonic{
          .heading = "its harmonics",
          .x = {.label = "Harmonic of the mesh frequency", .from = 0.4, .to = kShownHarmonics + 0.6},
          .y = {
              .label = text("Amplitude (", unit, ")"), .from = 0, .to = std::max(1.08 * most, 1e-4 * size)}};
  const std::vector<size_t> numbers = distinct_of(curves, high - low + 2 * room, most);
  note_alike(numbers, figure);
  const double drawn = static_cast<double>(count_of_distinct(numbers)), step = 0.8 / drawn;
  for (size_t i = 0; i < curves.size(); ++i) {
    PanelCurve curve = numbered_curve(period.name, i, numbers, of.periods > 1);
    if (is_first(numbers, i)) over_period.curves.push_back(curve);
    curve.label = without_markup(short_name(curves[i].name));
    curve.block = "";
    curve.width = 3;
    harmonic.curves.push_back(curve);
    if (!is_first(numbers, i)) continue;
    curve.label = "";
    curve.block = spectrum.name;
    curve.style = PanelStyle::bars;
    curve.width = 0.7 * step;
    curve.shift = (static_cast<double>(numbers[i]) - 0.5 * (drawn - 1)) * step;
    harmonic.curves.push_back(curve);
  }
  figure.panels.push_back(over_period);
  figure.panels.push_back(harmonic);
}

// How far the meshes of one [[mesh]] are from sharing the load equally; "" where none has several.
std::string sharing_words(const SystemStaticResult& a) {
  std::string out;
  for (const LoadSharing& of : load_sharing(a))
    out += text(out.empty() ? "load sharing factor (largest share times planets): " : ", ", of.name, " ",
                fixed(of.factor, 3), " (by mean shares ", fixed(of.mean_factor, 3), ")");
  return out;
}

void add_hunting(const SystemStaticResult& a, const char* more, Figure& figure) {
  if (a.hunting_periods > 1)
    figure.notes.push_back(
        text("teeth differ: the same ones meet again after ", a.hunting_periods, " mesh periods, ", more));
  plain_captions(figure.notes.size(), figure);
}

// MPa, of each body whose roots are known: largest in any of its meshes at each phase.
std::vector<PeriodCurve> root_stresses(const SystemStaticResult& a) {
  const System& s = a.settings.layout;
  std::vector<PeriodCurve> out;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    Eigen::VectorXd most = Eigen::VectorXd::Zero(a.mesh_phase.size());
    for (size_t m = 0; m < a.mesh.size(); ++m)
      for (size_t g = 0; g < kSides; ++g)
        if (const MatrixRM& stress = a.mesh[m].root_stress[g];
            stress.size() > 0 && s.meshes[m].side[g].body == static_cast<int>(b))
          most = most.cwiseMax(stress.rowwise().maxCoeff() * kInMegapascals);
    if (most.maxCoeff() > 0) out.push_back({s.bodies[b].name, most, {}});
  }
  return out;
}

}  // namespace

Figure system_static_figure(const SystemStaticResult& a) {
  if (!a.of_train())
    fail(Failure::input, "figure: this static.h5 is of a pair; fig12, fig13 and load-sharing draw it");
  const System& s = a.settings.layout;
  Figure figure;
  std::vector<PeriodCurve> stresses = root_stresses(a);
  figure.title = text("A train at rest: transmission errors, stiffnesses, forces",
                      stresses.empty() ? "" : ", root stresses");
  figure.notes = in_lines(bodies_words(s, a.torque.colwise().mean().transpose()));
  if (const std::string sharing = sharing_words(a); !sharing.empty())
    for (const std::string& line : in_lines(sharing)) figure.notes.push_back(line);
  figure.notes.emplace_back(
      "transmission error along the line of action, with the displacements of the bearings; mesh force along the normals of the flanks");
  figure.notes.emplace_back(
      "mesh stiffness: secant, of the transverse force over what it adds to the transmission error, without bearings");
  figure.notes.push_back(
      text("bearing force: its magnitude; on a rigid axis the sum of the contact forces",
           stresses.empty() ? "" : "; root stress: the largest beside the loaded flanks of a gear"));
  std::vector<PeriodCurve> errors, stiffnesses, forces, bearings;
  errors.reserve(s.meshes.size());
  stiffnesses.reserve(s.meshes.size());
  forces.reserve(s.meshes.size());
  bearings.reserve(s.bodies.size());
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    errors.push_back({mesh_name(s, m), a.mesh[m].transmission_error * kMicro, {}});
    stiffnesses.push_back({mesh_name(s, m), a.mesh[m].stiffness_secant * kMega, {}});
    forces.push_back({mesh_name(s, m), a.mesh_force.col(static_cast<Index>(m)), {}});
  }
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    Eigen::VectorXd size(a.mesh_phase.size());
    for (Index i = 0; i < size.size(); ++i)
      size[i] = a.bearing_force[static_cast<size_t>(i)].row(static_cast<Index>(b)).norm();
    bearings.push_back({s.bodies[b].name + (s.bodies[b].on != System::kGround ? " (pin)" : ""), size, {}});
  }
  const Phases phases{a.mesh_phase, a.hunting_periods};
  add_row(phases, "transmission_error", "Transmission error", "Error", "µm", std::move(errors), figure);
  add_row(phases, "mesh_stiffness", "Mesh stiffness", "Stiffness", "N/µm", std::move(stiffnesses), figure);
  add_row(phases, "mesh_force", "Mesh force", "Force", "N", std::move(forces), figure);
  add_row(phases, "bearing_force", "Bearing force", "Force", "N", std::move(bearings), figure);
  if (!stresses.empty())
    add_row(phases, "root_stress", "Root stress", "Stress", "MPa", std::move(stresses), figure);
  figure.columns = 2;
  add_hunting(a, "over which all is drawn; harmonics are those of the mesh frequency", figure);
  return figure;
}

namespace {

// Rows of one motion: its transmission errors, mesh forces and forces on bearings; way: "", or which of two motions it is.
void add_motion(const SweepResult& a, Index row, const std::string& way, Figure& figure) {
  const int periods = a.period_multiple[row] > 0 ? a.period_multiple[row]
                                                 : static_cast<int>(a.samples() / a.time.steps_per_period);
  const Index samples = std::min<Index>(periods * a.time.steps_per_period, a.samples());
  const Phases phases{VectorXd::LinSpaced(samples, 0, periods * (1 - 1.0 / static_cast<double>(samples))),
                      periods};
  const auto of_meshes = [&](const std::vector<MatrixRM>& values, double scale) {
    std::vector<PeriodCurve> out;
    for (size_t m = 0; m < a.mesh_names.size(); ++m)
      out.push_back({a.mesh_names[m],
                     values[static_cast<size_t>(row)].col(static_cast<Index>(m)).head(samples) * scale,
                     {}});
    return out;
  };
  std::vector<PeriodCurve> bearings;
  for (size_t b = 0; b < a.body_names.size(); ++b)
    if (!a.bearing_force[b].empty())
      bearings.push_back({a.body_names[b] + (a.layout.bodies[b].on != System::kGround ? " (pin)" : ""),
                          a.bearing_force[b][static_cast<size_t>(row)].topRows(samples).rowwise().norm(),
                          {}});
  const std::string of = way.empty() ? "" : " " + way, behind = way.empty() ? "" : ", speed " + way;
  add_row(phases, "transmission_error" + of, "Transmission error" + behind, "Error", "µm",
          of_meshes(a.transmission_error, kMicro), figure);
  add_row(phases, "mesh_force" + of, "Mesh force" + behind, "Force", "N", of_meshes(a.mesh_force, 1), figure);
  if (!bearings.empty())
    add_row(phases, "bearing_force" + of, "Bearing force" + behind, "Force", "N", std::move(bearings),
            figure);
}

}  // namespace

Figure train_history_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency) {
  constexpr double kSameBranch = 0.02;  // of the larger RMS
  std::vector<Index> rows;
  std::vector<double> rms;
  for (const SweepResult& a : sweeps) {
    if (!a.of_train() || !one_system(a.layout, sweeps[0].layout))
      fail(Failure::input, "figure: sweeps of another scene beside those of a train; give those of one");
    Index row = 0;
    const double off = (a.mesh_frequency.array() - mesh_frequency).abs().minCoeff(&row);
    if (off > 1e-6 * mesh_frequency)
      fail(Failure::input, "figure: the sweep ", a.direction, " holds no speed of ", mesh_frequency,
           " Hz; the nearest is ", a.mesh_frequency[row], " Hz");
    rows.push_back(row);
    rms.push_back(std::sqrt((a.transmission_error[static_cast<size_t>(row)].rowwise() -
                             a.transmission_error[static_cast<size_t>(row)].colwise().mean())
                                .squaredNorm()));
  }
  const bool one = sweeps.size() == 1 || (sweeps.size() == 2 && std::abs(rms[0] - rms[1]) <=
                                                                    kSameBranch * std::max(rms[0], rms[1]));
  const SweepResult& a = sweeps[0];
  Figure figure;
  figure.title = text("A train in motion at a mesh frequency of ", shown(mesh_frequency, 6), " Hz");
  figure.notes = in_lines(bodies_words(a.layout, a.drive));
  figure.notes.push_back(text("a mesh period lasts ", shown(1e3 / mesh_frequency, 4), " ms; ",
                              sweeps.size() == 1 ? text("speed ", a.direction)
                              : one              ? "with speed rising and falling the motion is the same"
                                                 : "with speed rising and falling it is another one"));
  figure.notes.emplace_back(
      "transmission error of the rotations, along the line of action; bearing force: its magnitude, on a rigid axis the sum of the contact forces");
  for (size_t i = 0; i < (one ? 1 : sweeps.size()); ++i)
    add_motion(sweeps[i], rows[i],
               one                                    ? ""
               : sweeps[i].direction == Direction::up ? "rising"
                                                      : "falling",
               figure);
  figure.columns = 2;
  plain_captions(figure.notes.size(), figure);
  return figure;
}

namespace {

// Loads of the tooth pairs of one mesh that carry load, over a mesh period of its own from 0 to 1: pairs are numbered anew where
// it begins, so that pair p at 1 is pair p + 1 at 0. Between positions of the statics the ends are interpolated. Where teeth differ it is
// the first whole one, and the next position is that behind its end.
FigureBlock pair_loads(const SystemStaticResult& a, size_t m, const std::string& table) {
  const StaticResult& mesh = a.mesh[m];
  const Index n = a.mesh_phase.size(), pairs = mesh.pair.size();
  FigureBlock block{table, {text("phase of ", mesh_name(a.settings.layout, m), " [1]")}, {}, table};
  std::vector<Index> loaded;
  for (Index p = 0; p < pairs; ++p) {
    if (!(mesh.tooth_load.col(p).maxCoeff() > 0)) continue;
    loaded.push_back(p);
    block.columns.push_back(text("load of pair ", mesh.pair[p], " [N]"));
  }
  // shift: mesh periods by which the row is moved; a pair is then where the one `shift` before it was.
  const auto row_of = [&](double phase, Index at, Index shift) {
    std::vector<double> row{phase + static_cast<double>(shift)};
    row.reserve(loaded.size() + 1);
    for (const Index p : loaded) {
      const Index from = p + shift;
      row.push_back(from >= 0 && from < pairs ? mesh.tooth_load(at, from) : 0);
    }
    return row;
  };
  std::vector<std::pair<double, Index>> order;
  order.reserve(static_cast<size_t>(n));
  constexpr double kRoundOff = 1e-9;  // a phase that it keeps below 1 is 0
  const double ahead = a.settings.layout.meshes[m].phase;
  for (Index i = 0; i < n; ++i) {
    const double own = a.mesh_phase[i] + ahead, part = own - std::floor(own),
                 in_period = part > 1 - kRoundOff ? 0 : part;
    if (a.hunting_periods > 1 && std::round(own - in_period) != std::ceil(ahead - kRoundOff)) continue;
    order.emplace_back(in_period, i);
  }
  if (order.empty())
    fail(Failure::input, "figure: the phases of the system at rest hold no whole mesh period of ",
         mesh_name(a.settings.layout, m), "; compute it again");
  std::sort(order.begin(), order.end());
  const double first = order.front().first, last = order.back().first;
  const Index at_first = order.front().second, at_last = order.back().second;
  // At `end`, 0 or 1, between the last position before it and the first one behind it.
  const auto end_row = [&](Index end) {
    const std::vector<double> before = row_of(last, at_last, end - 1), behind = row_of(first, at_first, end);
    const double share = (static_cast<double>(end) - before[0]) / (behind[0] - before[0]);
    std::vector<double> row{static_cast<double>(end)};
    row.reserve(before.size());
    for (size_t c = 1; c < before.size(); ++c) row.push_back((1 - share) * before[c] + share * behind[c]);
    return row;
  };
  block.rows.reserve(static_cast<size_t>(n) + 2);
  if (first > 0) block.rows.push_back(end_row(0));
  for (const auto& [phase, at] : order) block.rows.push_back(row_of(phase, at, 0));
  block.rows.push_back(end_row(1));
  return block;
}

// The shares of the meshes of one [[mesh]], `shown` of them, over the mesh period.
FigureBlock shares_block(const SystemStaticResult& a, const LoadSharing& of, size_t shown,
                         const std::string& table) {
  std::vector<PeriodCurve> shares(shown);
  std::vector<std::string> columns(shown);
  for (size_t i = 0; i < shown; ++i) {
    shares[i].values = a.load_share.col(static_cast<Index>(of.meshes[i])) * kPercent;
    columns[i] = "share of the load " + mesh_name(a.settings.layout, of.meshes[i]) + " [%]";
  }
  return period_block(table, columns, a.mesh_phase, a.hunting_periods, shares, table);
}

// Shares of all meshes, and the loads of the tooth pairs of the first.
void add_sharing_panels(const SystemStaticResult& a, const LoadSharing& of, const std::string& shares,
                        const FigureBlock& loads, double span, Figure& figure) {
  const System& s = a.settings.layout;
  const size_t shown = std::min(of.meshes.size(), kMostLines);
  Panel share{.heading = "shares of the load",
              .x = phase_axis(a.hunting_periods),
              .y = {.label = "Share (%)"},
              .rules = {{'y', kPercent / static_cast<double>(of.meshes.size()), "equal", kDark, 2, true}}};
  std::vector<Eigen::VectorXd> columns;
  columns.reserve(shown);
  for (size_t i = 0; i < shown; ++i)
    columns.emplace_back(a.load_share.col(static_cast<Index>(of.meshes[i])) * kPercent);
  const std::vector<size_t> numbers = distinct_curves(columns, span);
  note_alike(numbers, figure);
  for (size_t i = 0; i < shown; ++i) {
    PanelCurve curve = numbered_curve(is_first(numbers, i) ? shares : "", i, numbers, a.hunting_periods > 1);
    curve.label = without_markup(short_name(mesh_name(s, of.meshes[i])));
    share.curves.push_back(curve);
  }
  const std::string first = without_markup(short_name(mesh_name(s, of.meshes[0])));
  Panel load{.heading = "loads of the tooth pairs of " + first,
             .x = {.label = "Its mesh phase (mesh periods)", .from = 0, .to = 1},
             .y = {.label = "Load (N)", .from_zero = true}};
  // "load of pair 0 [N]" is pair 0.
  for (size_t j = 1; j < loads.columns.size(); ++j)
    load.curves.push_back({.block = loads.name,
                           .y = static_cast<int>(j) + 1,
                           .colour = curve_colour(j - 1),
                           .label = loads.columns[j].substr(8, loads.columns[j].size() - 8 - 4)});
  figure.panels.push_back(share);
  figure.panels.push_back(load);
}

}  // namespace

Figure system_load_sharing_figure(const SystemStaticResult& a) {
  const std::vector<LoadSharing> sharing = load_sharing(a);
  if (sharing.empty())
    fail(
        Failure::input,
        "figure: no [[mesh]] of the system stands for those of several planets, so none shares its load with another; make static draws the forces of all meshes");
  Figure figure;
  figure.title = "Load sharing among planets, at rest";
  figure.notes = in_lines(bodies_words(a.settings.layout, a.torque.colwise().mean().transpose()));
  for (const std::string& line : in_lines(sharing_words(a))) figure.notes.push_back(line);
  figure.notes.emplace_back(
      "left: share of the load of all meshes of a [[mesh]]; right: loads of the tooth pairs of its first mesh over a period of its own, 0: reference pair at the pitch point");
  double low = 100, high = 0;
  for (const LoadSharing& of : sharing)
    for (const size_t m : of.meshes) {
      const auto column = a.load_share.col(static_cast<Index>(m));
      low = std::min(low, column.minCoeff() * kPercent);
      high = std::max(high, column.maxCoeff() * kPercent);
    }
  const double room = std::max(0.12 * (high - low), 0.5);
  for (size_t k = 0; k < sharing.size(); ++k) {
    const LoadSharing& of = sharing[k];
    const std::string row = std::to_string(k + 1);
    const size_t shown = std::min(of.meshes.size(), kMostLines);
    if (shown < of.meshes.size())
      figure.notes.push_back(
          text(of.name, ": the shares of the first ", shown, " of ", of.meshes.size(), " meshes"));
    // By number: names may be long, and tables become files.
    figure.blocks.push_back(shares_block(a, of, shown, "share " + row));
    const FigureBlock loads = pair_loads(a, of.meshes[0], "loads " + row);
    add_sharing_panels(a, of, figure.blocks.back().name, loads, high - low + 2 * room, figure);
    figure.blocks.push_back(loads);
  }
  for (size_t k = 0; k < figure.panels.size(); k += 2)
    figure.panels[k].y.from = low - room, figure.panels[k].y.to = high + room;
  figure.columns = 2;
  add_hunting(a, "over which shares are drawn; tooth loads are those of one of them", figure);
  return figure;
}

}  // namespace whine
