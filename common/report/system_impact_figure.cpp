#include "report/system_impact_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

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

}  // namespace

Figure system_impact_figure(const SystemImpactResult& a) {
  Figure figure;
  figure.title = "Ring-down of a system: damping ratios and natural frequencies of its modes";
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
  if (modes.rows.empty()) fail(Failure::input, "figure: no mode of the system oscillates at all mesh phases");
  const Damping& damping = a.settings.damping;
  constexpr int kPoints = 100;
  const double low = 0.8 * from, high = 1.1 * to;
  for (int i = 0; i <= kPoints; ++i) {
    const double f = low + (high - low) * i / kPoints, w = 2 * std::numbers::pi * f,
                 ratio = (damping.rayleigh_mass + damping.rayleigh_stiffness * w * w) / (2 * w);
    if (!(ratio < 1)) continue;
    // Decays have the damped frequency.
    rayleigh.rows.push_back({f * std::sqrt(1 - ratio * ratio), ratio * kPercent});
  }
  for (const double f : a.rigid_frequency)
    if (f >= low && f <= high) rigid.rows.push_back({f});
  figure.blocks = {modes, rayleigh};
  if (!rigid.rows.empty()) figure.blocks.push_back(rigid);
  figure.panels = {ringdown_panel(low, high, rigid)};
  figure.notes.push_back(text(a.settings.layout.bodies.size(), " bodies, ", a.settings.layout.meshes.size(),
                              " meshes, body \"", a.settings.fidelity.body, "\"; ", a.mesh_phase.size(),
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
