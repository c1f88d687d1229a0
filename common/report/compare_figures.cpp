#include "report/compare_figures.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;

// What messages call the two artifacts.
const char* artifact_kind(const StaticResult&) {
  return "static.h5";
}
const char* artifact_kind(const ResponseResult&) {
  return "response.h5";
}

template <class Artifact>
void require_all_designs(const std::vector<OfDesign<Artifact>>& all, size_t designs) {
  if (designs < 2 || designs > kMostCurves)
    fail(Failure::input, "figure: ", designs, " designs given; two to ", kMostCurves, " can be compared");
  for (const auto& one : all)
    if (one.artifact.torque != all[0].artifact.torque)
      fail(Failure::input, "figure: the ", artifact_kind(one.artifact), " of ", one.design, " is at ",
           torque_words(one.artifact.torque), ", that of ", all[0].design, " at ",
           torque_words(all[0].artifact.torque), "; designs are compared at one torque");
}

}  // namespace

Figure compared_rest_figure(const std::vector<OfDesign<StaticResult>>& designs) {
  require_all_designs(designs, designs.size());
  Figure figure;
  figure.title = "Designs at rest, " + torque_words(designs.at(0).artifact.torque);
  std::vector<std::string> names;
  Panel error{.x = {.from = 0, .to = 1}, .y = {.label = "Static TE (µm)"}, .height = 300},
      stiffness{.x = {.label = "Mesh phase", .from = 0, .to = 1},
                .y = {.label = "Mesh stiffness (N/µm)", .from_zero = true},
                .key = PanelKey::none,
                .height = 260},
      amplitudes{.x = {.label = "Harmonic of the mesh frequency", .from = 0.4, .to = kShownHarmonics + 0.6},
                 .y = {.label = "Amplitude of TE (µm)", .from_zero = true},
                 .key = PanelKey::none,
                 .height = 240};
  const double wide = 0.8 / static_cast<double>(designs.size());
  for (size_t i = 0; i < designs.size(); ++i) {
    const auto& [name, s] = designs[i];
    if (std::find(names.begin(), names.end(), name) != names.end())
      fail(Failure::input, "figure: two static.h5 of ", name, " given; one of each design is wanted");
    names.push_back(name);
    FigureBlock period{text("period ", i + 1),
                       {"mesh_phase [1]", "transmission_error [µm]", "mesh_stiffness_secant [N/µm]"},
                       {},
                       "period",
                       name};
    for (Index k = 0; k < s.transmission_error.size(); ++k)
      period.rows.push_back(
          {s.mesh_phase[k], s.transmission_error[k] * kMicro, s.stiffness_secant[k] * kMega});
    // The mesh period closes.
    if (s.hunting_periods == 1 && !period.rows.empty())
      period.rows.push_back({period.rows.front()[0] + 1, period.rows.front()[1], period.rows.front()[2]});
    FigureBlock harmonics{
        text("harmonics ", i + 1), {"harmonic [1]", "transmission_error [µm]"}, {}, "harmonics", name};
    const Index last = std::min<Index>(kShownHarmonics, s.transmission_error_harmonic.size() - 1);
    for (Index n = 1; n <= last; ++n)
      harmonics.rows.push_back({static_cast<double>(n), s.transmission_error_harmonic[n] * kMicro});
    constexpr std::array kDash{1, 3, 5, 7, 4, 6};
    PanelCurve line{.block = period.name,
                    .colour = static_cast<int>(i) + 1,
                    .label = without_markup(name),
                    .width = 2.6,
                    .dash = kDash.at(i)};
    error.curves.push_back(line);
    line.y = 3;
    stiffness.curves.push_back(line);
    amplitudes.curves.push_back({.block = harmonics.name,
                                 .style = PanelStyle::bars,
                                 .colour = static_cast<int>(i) + 1,
                                 .width = 0.92 * wide,
                                 .shift = wide * (static_cast<double>(i) + 0.5) - 0.4});
    figure.blocks.push_back(std::move(period));
    figure.blocks.push_back(std::move(harmonics));
    figure.notes.push_back(name + ": " + pair_words(s));
  }
  plain_captions(names.size(), figure);
  figure.panels = {error, stiffness, amplitudes};
  return figure;
}

Figure compared_motion_figure(const std::vector<OfDesign<ResponseResult>>& sweeps) {
  std::vector<std::string> names;
  for (const auto& [name, r] : sweeps)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  require_all_designs(sweeps, names.size());
  Figure figure;
  figure.title = "Designs in motion, " + torque_words(sweeps.at(0).artifact.torque);
  const PanelAxis speed{.label = "Mesh frequency (Hz)", .speed = true};
  figure.panels = {
      {.x = speed, .y = {.label = "RMS of DTE (µm)", .from_zero = true, .level = true}},
      {.x = speed,
       .y = {.label = "Order 1 of DTE (µm)", .from_zero = true, .level = true},
       .key = PanelKey::none},
      {.x = speed, .y = {.label = "Tooth load / (T / r_b)", .from_zero = true}, .key = PanelKey::none}};
  for (size_t i = 0; i < names.size(); ++i) {
    std::string jumps;
    for (const Direction direction : {Direction::up, Direction::down}) {
      const auto is = [&](const auto& one) {
        return one.design == names[i] && one.artifact.direction == direction;
      };
      if (const auto found = std::count_if(sweeps.begin(), sweeps.end(), is); found != 1)
        fail(Failure::input, "figure: ", found, " sweeps ", direction, " of ", names[i],
             " given; one up and one down of each design are wanted");
      const ResponseResult& r = std::find_if(sweeps.begin(), sweeps.end(), is)->artifact;
      const auto other = std::find_if(sweeps.begin(), sweeps.end(), [&](const auto& one) {
        return one.design == names[i] && one.artifact.direction != direction;
      });
      const double force = r.torque / ToothGeometry(r.gear[0].design).base_radius();
      FigureBlock block{
          text(i + 1, " ", direction),
          {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_harmonic_1 [µm]", "tooth_load_max [T / r_b]"},
          {},
          "motion",
          text(names[i], " ", direction)};
      const std::vector<bool> broken = broken_after(r, other == sweeps.end() ? nullptr : &other->artifact);
      for (Index k = 0; k < r.mesh_frequency.size(); ++k) {
        block.rows.push_back({r.mesh_frequency[k], r.dte_rms(k, 0) * kMicro,
                              r.harmonics() > 0 ? r.dte_harmonic[static_cast<size_t>(k)](0, 0) * kMicro : 0,
                              r.tooth_load_max(k, 0) / force});
        if (broken[static_cast<size_t>(k)]) block.rows.emplace_back();
      }
      for (size_t p = 0; p < figure.panels.size(); ++p) {
        // The second stands on the first, and lets it show where both are alike.
        figure.panels[p].curves.push_back(
            {.block = block.name,
             .y = static_cast<int>(p) + 2,
             .colour = static_cast<int>(i) + 1,
             .label = direction == Direction::up ? without_markup(names[i]) : "",
             .width = i == 0 ? 4.4 : 2.6,
             .dash = direction == Direction::up ? 1 : 3});
        if (direction == Direction::up)
          figure.panels[p].rules.push_back(
              {'x', r.natural_frequency, p ? "" : "f_n", static_cast<int>(i) + 1});
      }
      jumps += text(jumps.empty() ? "" : ", ", direction == Direction::up ? "rising" : "falling");
      std::vector<double> at(r.jump_frequency.begin(), r.jump_frequency.end());
      std::sort(at.begin(), at.end());
      for (const double f : at) jumps += " " + fixed(f, 0);
      if (at.empty()) jumps += " none";
      figure.blocks.push_back(std::move(block));
    }
    figure.notes.push_back(names[i] + ": jumps in Hz, " + jumps);
  }
  figure.notes.push_back(
      "f_n: mean natural frequency over the mesh period, contact frozen under the static load");
  plain_captions(names.size(), figure);
  for (size_t p = 0; p + 1 < figure.panels.size(); ++p) figure.panels[p].x.label.clear();
  figure.panels[0].curves.push_back({.colour = kDark, .label = "dashed: speed falling", .dash = 3});
  std::vector<ResponseResult> all;
  all.reserve(sweeps.size());
  for (const auto& one : sweeps) all.push_back(one.artifact);
  figure.shafts = shafts_of_all(all);
  figure.levels = {{"dte_rms [µm]", false}, {"dte_harmonic_1 [µm]", true}};
  return figure;
}

}  // namespace whine
