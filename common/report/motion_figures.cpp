#include "report/figure_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/panel_layout.h"
#include "report/response_figures.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

struct Motion {
  const SweepResult* sweep = nullptr;
  Eigen::Index row = 0;
  int periods = 1;    // of one orbit, or all that is stored of a motion that is not periodic
  int first = 0;      // of these periods: the one that is shown amid its neighbours
  std::string title;  // which branch of which choices

  Eigen::Index per_period() const { return sweep->time.steps_per_period; }
  Eigen::VectorXd orbit(const std::vector<MatrixRM>& of_speeds) const {
    return of_speeds[static_cast<size_t>(row)].col(0).head(periods * per_period());
  }
};

Motion motion_at(const SweepResult& s, double frequency) {
  Motion m;
  m.sweep = &s;
  (s.mesh_frequency.array() - frequency).abs().minCoeff(&m.row);
  if (std::abs(s.mesh_frequency[m.row] - frequency) > 1e-6 * frequency)
    fail(Failure::input, "figure: the sweep ", s.direction, " at ", torque_words(s.torque),
         " holds no speed of ", frequency, " Hz; the nearest is ", s.mesh_frequency[m.row], " Hz");
  m.periods = s.period_multiple[m.row] > 0 ? s.period_multiple[m.row]
                                           : static_cast<int>(s.samples() / s.time.steps_per_period);
  return m;
}

std::vector<LumpedParameters> lumped_of(const std::vector<SweepResult>& sweeps) {
  std::vector<LumpedParameters> lumped;
  lumped.reserve(sweeps.size());
  for (const SweepResult& s : sweeps) lumped.push_back(s.lumped);
  return lumped;
}

std::vector<Motion> motions_at(const std::vector<SweepResult>& sweeps, double frequency,
                               CaptionSources background, Figure& figure) {
  constexpr double kSameBranch = 0.02;  // of the larger RMS: far above what periodicity leaves open
  if (sweeps.empty()) fail(Failure::input, "figure: no sweep.h5 given; an up and a down sweep are the least");
  std::vector<Motion> motions;
  background.lumped = lumped_of(sweeps);
  for (const auto& panel : panels_of(sweeps, background)) {
    constexpr size_t kWidth = 170;  // characters that fit into a line
    const std::string operating = operating_words(panel, background);
    if (panel.scene.size() + operating.size() > kWidth) {
      figure.notes.push_back(panel.scene);
      figure.notes.push_back(operating);
    } else {
      figure.notes.push_back(panel.scene + (panel.scene.empty() ? "" : "; ") + operating);
    }
    figure.notes.push_back(panel.choices);
    for (const auto& curve : panel.curves) {
      Motion up = motion_at(*curve.up, frequency), down = motion_at(*curve.down, frequency);
      const std::string damping =
          elastic(*curve.up)
              ? "η = " + shown(curve.up->damping.rayleigh_stiffness * kMicro, 6) + " µs"
              : name_of(curve.up->model) + " at " + shown(panel.lumped.damping_ratio * kPercent, 4) + " %";
      const auto rms = [](const Motion& m) { return harmonics(m.orbit(m.sweep->transmission_error), 0).rms; };
      const double of_up = rms(up), of_down = rms(down);
      if (std::abs(of_up - of_down) <= kSameBranch * std::max(of_up, of_down)) {
        up.title = damping + ": no second branch here, speed rising and falling agree";
        motions.push_back(up);
        continue;
      }
      Motion& upper = of_up > of_down ? up : down;
      Motion& lower = of_up > of_down ? down : up;
      upper.title = damping + ": upper branch, speed " + (of_up > of_down ? "rising" : "falling");
      lower.title = damping + ": lower branch, speed " + (of_up > of_down ? "falling" : "rising");
      motions.push_back(upper);
      motions.push_back(lower);
    }
  }
  if (motions.size() > kMostCurves)
    fail(Failure::input, "figure: ", motions.size(), " motions at ", frequency, " Hz; ", kMostCurves,
         " fit into a figure");
  return motions;
}

void set_motion_title(Figure& figure, const std::string& what, const std::vector<Motion>& motions,
                      double frequency) {
  figure.title = what + " at a mesh frequency of " + shown(frequency, 6) + " Hz, " +
                 torque_words(motions[0].sweep->torque);
  plain_captions(figure.notes.size(), figure);
}

// Shown of tooth loads: mesh periods about the middle one, teeth from two before tooth i to three after it.
constexpr int kFirstPeriod = -1, kPeriods = 3, kFirstTooth = -2, kLastTooth = 3;

// A panel with the loads of successive teeth and of all of them; shaded: contact lost. Blocks begin with `letter`, the heading with
// `title`, behind which stands the result in words.
void add_tooth_loads(Figure& figure, const std::string& letter, const Motion& m, const std::string& title) {
  const Eigen::Index n = m.per_period();
  const Eigen::VectorXd force = m.orbit(m.sweep->mesh_force);
  const MatrixRM& loads = m.sweep->tooth_load[m.row];
  // Sample k of the shown periods: its place in the orbit, its period, its phase.
  const auto row_of = [&](Eigen::Index k) {
    return (k + (kPeriods * m.periods + m.first + kFirstPeriod) * n) % force.size();
  };
  const auto phase_of = [&](Eigen::Index k) { return kFirstPeriod + static_cast<double>(k) / n; };
  FigureBlock net{
      letter + " mesh force", {"phase of tooth i [1]", "force [N]"}, {}, "loads", letter + " all teeth"};
  FigureBlock lost{letter + " contact lost", {"from phase [1]", "to phase [1]"}, {}, "contact lost", letter};
  for (Eigen::Index k = 0; k <= kPeriods * n; ++k) {
    const double f = force[row_of(k)];
    net.rows.push_back({phase_of(k), f});
    if (f > 0) continue;
    if (k > 0 && !lost.rows.empty() && force[row_of(k - 1)] == 0)
      lost.rows.back()[1] = phase_of(k);
    else
      lost.rows.push_back({phase_of(k), phase_of(k)});
  }
  Panel panel{.x = {.label = "Phase of tooth i (mesh periods, 0: it touches at the pitch point)",
                    .from = kFirstPeriod,
                    .to = kFirstPeriod + kPeriods},
              .y = {.label = "Force (N)", .from_zero = true},
              .rules = {rest_rule(m.sweep->gear[0].design, m.sweep->torque)}};
  if (!lost.rows.empty())
    panel.curves.push_back(
        {.block = lost.name, .style = PanelStyle::spans, .colour = kShade, .label = "contact lost"});
  panel.curves.push_back({.block = net.name, .colour = kDark, .label = "all teeth", .width = 1.6, .dash = 4});
  figure.blocks.push_back(net);
  figure.blocks.push_back(lost);
  // Pair j is j places ahead of the reference pair, which touches at the pitch point at the start of a period: the tooth
  // that does so t periods after tooth i is pair (period - t). Drawn while it carries load, with a sample on either side.
  bool others = false;
  for (int t = kFirstTooth; t <= kLastTooth; ++t) {
    FigureBlock tooth{
        text(letter, " tooth i", t < 0 ? "" : "+", t), {"phase of tooth i [1]", "force [N]"}, {}, "loads"};
    tooth.curve = tooth.name;
    const auto load_at = [&](Eigen::Index k) {
      const Eigen::Index j = kFirstPeriod + k / n - t - m.sweep->pair[0];
      return k >= 0 && k < kPeriods * n && j >= 0 && j < loads.cols() ? loads(row_of(k), j) : 0.0;
    };
    for (Eigen::Index k = 0; k < kPeriods * n; ++k)
      if (load_at(k - 1) > 0 || load_at(k) > 0 || load_at(k + 1) > 0)
        tooth.rows.push_back({phase_of(k), load_at(k)});
      else if (!tooth.rows.empty() && !tooth.rows.back().empty())
        tooth.rows.emplace_back();
    if (!tooth.rows.empty()) {
      const bool own = t == 0 || t == 1;
      panel.curves.push_back({.block = tooth.name,
                              .colour = t == 0 ? kBlue
                                        : own  ? kVermilion
                                               : kPale,
                              .label = t == 0   ? "tooth i"
                                       : own    ? "tooth i + 1"
                                       : others ? ""
                                                : "other teeth",
                              .width = own ? 3.0 : 1.8});
      others = others || !own;
    }
    figure.blocks.push_back(tooth);
  }
  const Separations apart = separations(force);
  const double most = loads.topRows(force.size()).maxCoeff(), largest = std::max(most, force.maxCoeff());
  panel.y.to = 1.08 * (largest > 0 ? largest : 1);
  panel.heading =
      title + text("largest tooth load ", fixed(most, 0),
                   " N = ", fixed(most / normal_force(m.sweep->gear[0].design, m.sweep->torque), 2), " ",
                   rest_force_name(m.sweep->gear[0].design), "; ");
  panel.heading += apart.intervals == 0
                       ? "contact is never lost"
                       : text("contact lost ", shown(static_cast<double>(apart.intervals) / m.periods, 3),
                              apart.intervals == m.periods ? " time" : " times", " a mesh period, for ",
                              fixed(100 * apart.fraction, 1), " % of it");
  figure.panels.push_back(panel);
}

// The largest load of a tooth pair against speed, of the blocks "up" and "down"; marks of lost contact at its foot.
Panel load_over_speed(double most, Eigen::Index speeds, bool lost, bool beyond) {
  constexpr int kLost = 4, kLoad = 6, kBeyond = 8;  // columns
  Panel panel{.heading = "largest load of a tooth pair",
              .x = {.label = "Mesh frequency (Hz)", .speed = true},
              .y = {.label = "Force (N)", .from_zero = true}};
  for (const bool falling : {true, false})
    panel.curves.push_back({.block = falling ? "down" : "up",
                            .y = kLoad,
                            .style = PanelStyle::line_points,
                            .colour = falling ? kVermilion : kBlue,
                            .label = falling ? "speed falling" : "speed rising",
                            .width = falling ? 2.6 : 1.4,
                            .mark = falling ? 10 : 9,
                            .size = falling ? 1.6 : 1.3,
                            .every = 2 * mark_stride(speeds),
                            .first = falling ? mark_stride(speeds) : 0});
  if (lost) {
    for (const bool falling : {true, false})
      panel.curves.push_back({.block = falling ? "down" : "up",
                              .style = PanelStyle::points,
                              .colour = falling ? kVermilion : kBlue,
                              .mark = 5,
                              .size = 0.6,
                              .where = kLost,
                              .at = (falling ? 0.035 : 0.015) * most});
    panel.curves.push_back(
        {.style = PanelStyle::points, .colour = kDark, .label = "contact lost", .mark = 5});
  }
  if (beyond)
    for (const bool falling : {true, false})
      panel.curves.push_back({.block = falling ? "down" : "up",
                              .y = kLoad,
                              .style = PanelStyle::points,
                              .colour = kBlack,
                              .label = falling ? "" : "beyond backlash",
                              .width = 1.4,
                              .mark = 6,
                              .size = 1.1,
                              .where = kBeyond});
  return panel;
}

// Of each `group` neighbouring speeds the spectrum of the one with the largest RMS, up to `end` (Hz): a ray over speed for each order, half ones
// where the motion repeats after two periods.
FigureBlock spectra_block(const SweepResult& sweep, const ResponseResult& r, Eigen::Index group, double end) {
  FigureBlock lines{text("spectra ", sweep.direction),
                    {"mesh_frequency [Hz]", "frequency [Hz]", "amplitude [µm]"},
                    {},
                    "spectra",
                    name_of(sweep.direction)};
  const Eigen::Index speeds = r.mesh_frequency.size();
  struct Ray {
    std::vector<std::vector<double>> rows;
    Eigen::Index last = -1;  // number of the group of its last speed
  };
  std::map<double, Ray> rays;
  for (Eigen::Index g = 0; g < speeds; g += group) {
    Eigen::Index row = 0;
    r.dte_rms.col(0).segment(g, std::min(group, speeds - g)).maxCoeff(&row);
    const double f = r.mesh_frequency[g + row];
    const Motion m = motion_at(sweep, f);
    const Eigen::VectorXd x = m.orbit(sweep.transmission_error);
    const int count = resolved_harmonics(x.size(), static_cast<int>(std::floor(end / f * m.periods)));
    const Harmonics h = harmonics(x, count);
    for (int k = 1; k <= count; ++k) {
      const double order = static_cast<double>(k) / m.periods;
      Ray& ray = rays[order];
      if (ray.last >= 0 && ray.last + 1 < g / group) ray.rows.emplace_back();  // it was not there between
      ray.last = g / group;
      ray.rows.push_back({f, order * f, h.amplitude[k - 1] * kMicro});
    }
  }
  for (const auto& [order, ray] : rays) {
    if (!lines.rows.empty()) lines.rows.emplace_back();
    lines.rows.insert(lines.rows.end(), ray.rows.begin(), ray.rows.end());
  }
  return lines;
}

// Lines of the first orders with their numbers where they leave the panel, f_n, and the spectra as colours over three decades.
Panel spectra_panel(const FigureBlock& spectra, const AxisRange& speeds, double end, double largest,
                    double natural_frequency, Figure& figure) {
  constexpr int kOrders = 5;
  constexpr double kBelowTop = 0.03, kSeen = 0.1;  // of the panel
  Panel panel{
      .x = {.label = "Frequency (Hz)", .from = 0, .to = end},
      .y = {.label = "Mesh frequency (Hz)", .from = speeds.from, .to = speeds.to, .speed = true},
      .rules = {{.at = natural_frequency, .label = "f_n"}},
      .key = PanelKey::none,
      .height = 560,
      .colours = PanelAxis{
          .label = "Amplitude (µm)", .from = 1e-3 * largest, .to = largest, .log = true, .level = true}};
  FigureBlock orders{"orders " + spectra.curve, {"mesh_frequency [Hz]", "frequency [Hz]"}, {}, "", "", true};
  for (int k = 1; k <= kOrders && k * speeds.from < end; ++k) {
    const double top = std::min(speeds.to, end / k);
    orders.rows.insert(orders.rows.end(), {{speeds.from, k * speeds.from}, {top, k * top}, {}});
    const double number = top - kBelowTop * speeds.span();
    if (top - speeds.from > kSeen * speeds.span())
      panel.words.push_back({std::to_string(k), k * number, number, true});
  }
  panel.curves = {{.block = orders.name, .x = 2, .y = 1, .colour = kLight, .width = 1, .dash = 4},
                  {.block = spectra.name,
                   .x = 2,
                   .y = 1,
                   .style = PanelStyle::line_points,
                   .width = 7,
                   .mark = 5,
                   .size = 0.6,
                   .heat = 3}};
  figure.blocks.push_back(std::move(orders));
  return panel;
}

}  // namespace

Figure vibration_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency,
                        const CaptionSources& background) {
  constexpr int kShownPeriods = 3;
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, background, figure);
  set_motion_title(figure, "Oscillating dynamic transmission error (DTE)", motions, mesh_frequency);
  figure.columns = 2;
  double largest = 0, largest_amplitude = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    const Motion& m = motions[i];
    const Eigen::VectorXd x = m.orbit(m.sweep->transmission_error);
    const int count = resolved_harmonics(x.size(), kShownHarmonics * m.periods);
    if (count < 1)
      fail(Failure::input, "figure: ", x.size(),
           " samples do not resolve the mesh frequency; raise steps_per_period");
    const Harmonics h = harmonics(x, count);
    const std::string curve = letter_of(i) + " " + m.title;
    FigureBlock history{
        letter_of(i) + " history", {"time [ms]", "oscillating dte [µm]"}, {}, "histories", curve};
    const Eigen::Index shown_samples = std::max(kShownPeriods, m.periods) * m.per_period();
    for (Eigen::Index n = 0; n <= shown_samples; ++n) {
      const double value = (x[n % x.size()] - h.mean) * kMicro;
      history.rows.push_back({1e3 * n / (m.per_period() * mesh_frequency), value});
      largest = std::max(largest, std::abs(value));
    }
    FigureBlock spectrum{
        letter_of(i) + " spectrum", {"frequency [Hz]", "amplitude [µm]"}, {}, "spectra", curve};
    for (int k = 1; k <= count; ++k)
      spectrum.rows.push_back({k * mesh_frequency / m.periods, h.amplitude[k - 1] * kMicro});
    Eigen::Index strongest = 0;
    const double amplitude = h.amplitude.maxCoeff(&strongest);
    largest_amplitude = std::max(largest_amplitude, amplitude * kMicro);
    figure.panels.push_back({.heading = m.title + "; mean " + shown(h.mean * kMicro, 3) + " µm",
                             .x = {.label = "Time (ms)", .from = 0, .to = history.rows.back()[0]},
                             .y = {.label = "Oscillating DTE (µm)"},
                             .curves = {{.block = history.name}},
                             .height = 270});
    figure.panels.push_back(
        {.heading =
             text("RMS ", shown(h.rms * kMicro, 3), " µm, ", shown(50 * std::pow(amplitude / h.rms, 2), 3),
                  " % of its square at ", shown((strongest + 1.0) / m.periods, 3), " × mesh frequency"),
         .x = {.label = "Frequency (Hz)", .from = 0, .to = 1.03 * kShownHarmonics * mesh_frequency},
         .y = {.label = "Amplitude (µm)", .from = 0},
         .curves = {{.block = spectrum.name, .style = PanelStyle::stems, .width = 3, .size = 0.9}},
         .height = 270});
    figure.blocks.push_back(history);
    figure.blocks.push_back(spectrum);
  }
  // All motions on the same scales.
  for (size_t p = 0; p < figure.panels.size(); ++p) {
    PanelAxis& y = figure.panels[p].y;
    y.to = p % 2 ? 1.1 * largest_amplitude : 1.06 * largest;
    if (p % 2 == 0) y.from = -y.to;
  }
  return figure;
}

Figure tooth_load_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency,
                         const CaptionSources& background) {
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, background, figure);
  set_motion_title(figure, "Tooth loads", motions, mesh_frequency);
  double to = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    add_tooth_loads(figure, letter_of(i), motions[i], motions[i].title + "\n");
    to = std::max(to, figure.panels.back().y.to);
  }
  for (Panel& panel : figure.panels) {
    panel.y.to = to;
    panel.height = 240;
    if (&panel != &figure.panels.back()) panel.x.label.clear();
  }
  return figure;
}

Figure dynamic_load_figure(const std::vector<SweepResult>& sweeps, CaptionSources background) {
  background.lumped = lumped_of(sweeps);
  const auto panels = panels_of(sweeps, background);
  const auto& curve = only_curve(panels, "tooth loads against speed");
  Figure figure;
  figure.title = "Tooth loads against mesh frequency, " + torque_words(curve.up->torque);
  figure.notes = {operating_words(panels[0], background), panels[0].choices};
  figure.shafts = shafts_of_all(sweeps);
  Motion worst;
  double rms = -1;
  bool lost = false;
  const std::array<ResponseResult, 2> both{response(*curve.up), response(*curve.down)};
  for (const SweepResult* sweep : {curve.up, curve.down}) {
    const ResponseResult& r = both[sweep == curve.up ? 0 : 1];
    figure.blocks.push_back(
        response_block(name_of(sweep->direction), r, &both[sweep == curve.up ? 1 : 0], elastic(*sweep)));
    Eigen::Index row = 0;
    if (const double here = r.dte_rms.col(0).maxCoeff(&row); here > rms) {
      rms = here;
      worst = motion_at(*sweep, r.mesh_frequency[row]);
    }
    lost |= r.separation_fraction.maxCoeff() > 0;
  }
  // Of several periods that differ the one with the largest load in the middle.
  Eigen::Index sample = 0;
  worst.sweep->tooth_load[worst.row]
      .topRows(worst.periods * worst.per_period())
      .rowwise()
      .maxCoeff()
      .maxCoeff(&sample);
  worst.first = static_cast<int>(sample / worst.per_period());
  const double speed = worst.sweep->mesh_frequency[worst.row];
  figure.panels.push_back(load_over_speed(
      std::max(both[0].tooth_load_max.maxCoeff(), both[1].tooth_load_max.maxCoeff()),
      curve.up->mesh_frequency.size(), lost, !speeds_beyond_backlash({&both[0], &both[1]}).empty()));
  figure.panels[0].rules = {rest_rule(curve.up->gear[0].design, curve.up->torque), {'x', speed, "(b)"}};
  add_tooth_loads(
      figure, "b", worst,
      text("at ", shown(speed, 6), " Hz, speed ",
           worst.sweep->direction == Direction::up ? "rising" : "falling",
           ", where the RMS of the transmission error is largest (", shown(rms * kMicro, 3), " µm)\n"));
  return figure;
}

Figure waterfall_figure(const std::vector<SweepResult>& sweeps) {
  constexpr Eigen::Index kMostSpectra = 160;
  constexpr double kLeast = 1e-4;  // of the largest amplitude
  if (sweeps.empty() || sweeps.size() > 2)
    fail(Failure::input, "figure: ", sweeps.size(),
         " sweep.h5 given; a waterfall is of a sweep, or of those up and down");
  if (sweeps.size() == 2) panels_of(sweeps, CaptionSources{{}, lumped_of(sweeps), {}});
  std::vector<const SweepResult*> shown;
  for (const Direction direction : {Direction::up, Direction::down})
    for (const SweepResult& sweep : sweeps)
      if (sweep.direction == direction) shown.push_back(&sweep);
  const SweepResult& first = *shown.front();
  Figure figure;
  figure.shafts = shafts_of_all(sweeps);
  figure.levels = {{"amplitude [µm]", true}};
  figure.title = text("Spectra of the dynamic transmission error against mesh frequency, ",
                      torque_words(first.torque), ", ",
                      shown.size() == 2                  ? "speed rising and falling"
                      : first.direction == Direction::up ? "speed rising"
                                                         : "speed falling");
  figure.notes.push_back(elastic(first) ? choice_words(first)
                                        : choice_words(first) + "; " + lumped_words(first.lumped));
  AxisRange speeds{std::numeric_limits<double>::infinity(), 0};
  double end = 0, largest = 0;
  Eigen::Index group = 1;
  for (const SweepResult* sweep : shown) {
    speeds.from = std::min(speeds.from, sweep->mesh_frequency.minCoeff());
    speeds.to = std::max(speeds.to, sweep->mesh_frequency.maxCoeff());
    end = std::max({end, 2.5 * sweep->natural_frequency, 1.5 * speeds.to});
    group = std::max(group, (sweep->mesh_frequency.size() + kMostSpectra - 1) / kMostSpectra);
  }
  for (const SweepResult* sweep : shown)
    for (const auto& row :
         figure.blocks.emplace_back(spectra_block(*sweep, response(*sweep), group, end)).rows)
      if (!row.empty()) largest = std::max(largest, row[2]);
  for (FigureBlock& block : figure.blocks)
    for (auto& row : block.rows)
      if (!row.empty() && row[2] < kLeast * largest) row.clear();
  const double margin = 0.02 * (speeds.span() > 0 ? speeds.span() : 0.2 * speeds.to);
  for (size_t i = 0; i < shown.size(); ++i) {
    Panel panel = spectra_panel(FigureBlock(figure.blocks[i]), {speeds.from - margin, speeds.to + margin},
                                end, largest > 0 ? largest : 1, first.natural_frequency, figure);
    if (shown.size() == 2)
      panel.heading = text("speed ", shown[i]->direction == Direction::up ? "rising" : "falling");
    figure.panels.push_back(std::move(panel));
  }
  figure.notes.push_back(
      group == 1 ? "a spectrum at each speed"
                 : text("of ", group, " neighbouring speeds the spectrum of the one with the largest RMS"));
  return figure;
}

Figure mesh_force_figure(const std::vector<SweepResult>& sweeps,
                         const std::vector<double>& mesh_frequencies) {
  if (sweeps.empty()) fail(Failure::input, "figure: no sweep.h5 given; 1 is the least");
  if (sweeps.size() > kMostCurves)
    fail(Failure::input, "figure: ", sweeps.size(), " sweep.h5 given; ", kMostCurves,
         " curves can be told apart");
  if (mesh_frequencies.empty() || mesh_frequencies.size() > 2)
    fail(Failure::input, "figure: ", mesh_frequencies.size(),
         " mesh frequencies given; one or two are shown");
  Figure figure;
  const double torque = sweeps[0].torque;
  figure.title = text("Net mesh force of one degree of freedom (Eq. 23), ", torque_words(torque));
  const PanelRule at_rest = rest_rule(sweeps[0].gear[0].design, torque);
  for (size_t k = 0; k < mesh_frequencies.size(); ++k)
    figure.panels.push_back({.x = {.label = "Time (mesh periods, 0: pitch point)", .from = 0, .to = 2},
                             .y = {.label = k ? "" : "Net mesh force (N)"},
                             .rules = {at_rest},
                             .key = PanelKey::below,
                             .height = 380});
  figure.columns = figure.panels.size();
  double largest = 0;
  // How each sweep is drawn: Curve::dash and its name.
  constexpr std::array<std::pair<int, const char*>, kMostCurves> kDashes{
      {{1, "solid"}, {3, "dashed"}, {4, "dotted"}, {5, "dash-dotted"}, {7, "long dashes"}, {6, "fine dots"}}};
  for (size_t s = 0; s < sweeps.size(); ++s) {
    const SweepResult& sweep = sweeps[s];
    if (sweep.lumped.cell_end.size() == 0)
      fail(Failure::input, "figure: a sweep of elastic gears given; give those of lumped models");
    if (sweep.torque != torque)
      fail(Failure::input, "figure: sweeps at ", torque, " and ", sweep.torque,
           " N m; give those of one torque");
    const double low = sweep.lumped.stiffness.minCoeff(), high = sweep.lumped.stiffness.maxCoeff();
    const bool rising = sweep.direction == Direction::up;
    std::string jumps;
    for (double f : sweep.jump_frequency) jumps += (jumps.empty() ? ", jump at " : ", ") + fixed(f, 1);
    figure.notes.push_back(text(kDashes[s].second, ": ", sweep.model, " stiffness, ", fixed(low * kMega, 1),
                                " to ", fixed(high * kMega, 1), " N/µm (ratio ", fixed(high / low, 3),
                                "), mean ", fixed(sweep.mean_stiffness * kMega, 1), "; ",
                                lumped_words(sweep.lumped), "; speed ", rising ? "rising" : "falling",
                                jumps.empty() ? ", no jump" : jumps + " Hz"));
    for (size_t k = 0; k < mesh_frequencies.size(); ++k) {
      Eigen::Index row = 0;
      (sweep.mesh_frequency.array() - mesh_frequencies[k]).abs().minCoeff(&row);
      const double f = sweep.mesh_frequency[row];
      const Eigen::Index samples = sweep.time.steps_per_period, stored = sweep.samples();
      const Eigen::VectorXd force = sweep.mesh_force[static_cast<size_t>(row)].col(0),
                            error = sweep.transmission_error[static_cast<size_t>(row)].col(0);
      FigureBlock block{text(letter_of(k), " ", s + 1),
                        {"time [mesh periods]", "mesh_force [N]", "transmission_error [µm]"},
                        {},
                        "forces",
                        text(shown(f, 6), " Hz, sweep ", s + 1)};
      for (Eigen::Index i = 0; i <= 2 * samples; ++i)
        block.rows.push_back({static_cast<double>(i) / static_cast<double>(samples), force[i % stored],
                              error[i % stored] * kMicro});
      figure.blocks.push_back(block);
      largest = std::max(largest, force.maxCoeff());
      // The jump that the sweep comes to next, else the one that it has behind it.
      double next = 0, behind = 0;
      for (double jump : sweep.jump_frequency) {
        double& side = (jump > f) == rising ? next : behind;
        if (side == 0 || std::abs(jump - f) < std::abs(side - f)) side = jump;
      }
      figure.panels[k].curves.push_back(
          {.block = block.name,
           .colour = static_cast<int>(s) + 1,
           .label = text(shown(f, 6), " Hz, ratio ", fixed(high / low, 3),
                         next > 0     ? ", before its jump at " + fixed(next, 0) + " Hz"
                         : behind > 0 ? ", after its jump at " + fixed(behind, 0) + " Hz"
                                      : ", no jump"),
           .dash = kDashes[s].first});
    }
  }
  for (Panel& panel : figure.panels) {
    panel.y.from = -0.03 * largest;
    panel.y.to = 1.1 * largest;
  }
  return figure;
}

}  // namespace whine
