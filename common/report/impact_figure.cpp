#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/one_system.h"

namespace whine {

using Eigen::Index;

namespace {

Panel ringdown_panel(double from, double to, const FigureBlock& rigid) {
  Panel panel{.x = {.label = "Natural frequency (Hz)", .from = from, .to = to},
              .y = {.label = "Damping ratio (%)", .from_zero = true},
              .curves = {{.block = "rayleigh",
                          .colour = kVermilion,
                          .label = "Rayleigh damping if it damped all that deforms",
                          .width = 2,
                          .dash = 3},
                         {.block = "modes",
                          .x = 2,
                          .y = 5,
                          .style = PanelStyle::ranges,
                          .label = "decays: mean, range over the mesh phases",
                          .width = 1.8,
                          .box = {3, 4, 6, 7}},
                         {.block = "modes",
                          .x = 9,
                          .y = 8,
                          .style = PanelStyle::points,
                          .colour = kBlack,
                          .label = "eigenvalues, frozen contact: mean",
                          .width = 1.6,
                          .mark = 6,
                          .size = 2.2}},
              .key = PanelKey::below,
              .height = 560};
  for (const auto& row : rigid.rows) {
    const bool first = panel.rules.empty();
    panel.rules.push_back(
        {.at = row[0],
         .label = first ? "natural frequencies of rigid gears on the mean mesh stiffness" : "",
         .dash = 1,
         .in_key = first});
  }
  return panel;
}

// Decays of a pair by its contact.
void add_states(const ContactStateDecays& a, Figure& figure) {
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    const ContactState state = a.contact_state[static_cast<size_t>(i)];
    const std::string name = state == ContactState::mean  ? "mean over the period"
                             : state == ContactState::one ? "one pair"
                                                          : name_of(state) + " pairs";
    figure.blocks.push_back(
        {name,
         {"natural_frequency [Hz]", "damping_ratio [%]", "undamped_frequency [Hz]"},
         {{a.natural_frequency[i], a.damping_ratio[i] * kPercent, a.undamped_frequency[i]}},
         "states",
         name});
    figure.panels[0].curves.push_back({.block = name,
                                       .style = PanelStyle::points,
                                       .colour = curve_colour(static_cast<size_t>(i) + 1),
                                       .label = "decay, " + name,
                                       .size = 1.6});
  }
}

}  // namespace

Figure impact_figure(const ImpactResult& a) {
  Figure figure;
  figure.title = text("Ring-down", a.of_train() ? " of a train" : ", " + torque_words(a.torque),
                      ": damping ratios and natural frequencies of its modes");
  FigureBlock modes{"modes",
                    {"mode", "natural_frequency [Hz]", "least over the mesh phases [Hz]",
                     "largest over the mesh phases [Hz]", "damping_ratio [%]", "least ratio [%]",
                     "largest ratio [%]", "by eigenvalues [%]", "eigenvalues [Hz]"},
                    {}},
      rayleigh{"rayleigh", {"frequency [Hz]", "damping_ratio [%]"}, {}, "rayleigh"},
      rigid{"rigid", {"rigid_frequency [Hz]"}, {}, "rigid"};
  double from = 0, to = 0;
  int overdamped = 0;
  for (Index k = 0; k < a.damping_ratio.cols(); ++k) {
    const auto f = a.natural_frequency.col(k), ratio = a.damping_ratio.col(k);
    if (f.minCoeff() == 0) {
      ++overdamped;
      continue;
    }
    modes.rows.push_back({static_cast<double>(k + 1), f.mean(), f.minCoeff(), f.maxCoeff(),
                          ratio.mean() * kPercent, ratio.minCoeff() * kPercent, ratio.maxCoeff() * kPercent,
                          a.eigen_damping_ratio.col(k).mean() * kPercent, a.eigen_frequency.col(k).mean()});
    from = modes.rows.size() == 1 ? f.minCoeff() : std::min(from, f.minCoeff());
    to = std::max(to, f.maxCoeff());
  }
  if (modes.rows.empty()) fail(Failure::input, "figure: no mode oscillates at all mesh phases");
  const Damping& damping = a.damping;
  constexpr int kPoints = 100;
  const double low = 0.8 * from, high = 1.1 * to;
  for (int i = 0; i <= kPoints; ++i) {
    const double f = low + (high - low) * i / kPoints, ratio = rayleigh_ratio(damping, f);
    if (!(ratio < 1)) continue;
    // Decays have the damped frequency.
    rayleigh.rows.push_back({f * std::sqrt(1 - ratio * ratio), ratio * kPercent});
  }
  for (const double f : a.rigid_frequency)
    if (f >= low && f <= high) rigid.rows.push_back({f});
  figure.blocks = {modes, rayleigh};
  if (!rigid.rows.empty()) figure.blocks.push_back(rigid);
  figure.panels = {ringdown_panel(low, high, rigid)};
  add_states(a.states, figure);
  figure.notes.push_back(text(a.bodies(), " bodies, ", a.meshes(), a.meshes() == 1 ? " mesh" : " meshes",
                              ", body \"", a.fidelity.body, "\"; ", a.mesh_phase.size(),
                              " mesh phases: bars from the least to the largest"));
  figure.notes.push_back(text("[damping] ", shown(damping.rayleigh_stiffness, 3), " s x stiffness + ",
                              shown(damping.rayleigh_mass, 3), " 1/s x mass, dampers of the axes ",
                              shown(damping.bearing_ratio, 3),
                              " of critical; bearings have their own, and contact near the flanks has none"));
  if (overdamped > 0)
    figure.notes.push_back(text(overdamped, " modes are damped above critical and are not shown"));
  return figure;
}

}  // namespace whine
