#include "report/figure_list.h"

#include <algorithm>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "report/response_figures.h"
#include "report/system_picture.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr double kLastOrder = 3.5, kFloor = 1e-12;  // of the mesh frequency; m: below, nothing but round-off

// Transmission error and residual signal over the hunting period, and its orders.
void add_signal(const SweepResult& sweep, const ResponseResult& r, Index speed, Index mesh, Figure& figure) {
  const auto at = static_cast<size_t>(speed);
  const Index steps = sweep.time.steps_per_period, samples = steps * r.hunting_periods;
  const Eigen::VectorXd error = sweep.transmission_error[at].col(mesh).head(samples),
                        residual = residual_signal(error, r.hunting_periods);
  FigureBlock signal{"signal", {"mesh_periods [1]", "transmission_error [µm]", "residual_signal [µm]"}, {}};
  signal.rows.reserve(static_cast<size_t>(samples));
  for (Index i = 0; i < samples; ++i)
    signal.rows.push_back(
        {static_cast<double>(i) / static_cast<double>(steps), error[i] * kMicro, residual[i] * kMicro});
  FigureBlock orders{"orders", {"order [1]", "amplitude [µm]"}, {}};
  const MatrixRM& amplitude = r.dte_order[at];
  for (Index k = 1; k <= amplitude.rows() && static_cast<double>(k) <= kLastOrder * r.hunting_periods; ++k)
    orders.rows.push_back(
        {static_cast<double>(k) / r.hunting_periods, std::max(kFloor, amplitude(k - 1, mesh)) * kMicro});
  figure.blocks.push_back(std::move(signal));
  figure.blocks.push_back(std::move(orders));
}

// RMS and kurtosis of the residual signal over speed.
void add_speeds(const ResponseResult& r, Index mesh, Figure& figure) {
  FigureBlock speeds{"speeds", {"mesh_frequency [Hz]", "residual_rms [µm]", "residual_kurtosis [1]"}, {}};
  for (Index i = 0; i < r.mesh_frequency.size(); ++i) {
    if (i > 0 && jumps_between(r, r.mesh_frequency[i - 1], r.mesh_frequency[i])) speeds.rows.emplace_back();
    speeds.rows.push_back(
        {r.mesh_frequency[i], r.residual_rms(i, mesh) * kMicro, r.residual_kurtosis(i, mesh)});
  }
  figure.blocks.push_back(std::move(speeds));
}

std::vector<Panel> panels_of_signal(const ResponseResult& r, const std::string& where) {
  const PanelAxis periods{.label = "Mesh periods", .from = 0, .to = static_cast<double>(r.hunting_periods)},
      speed{.label = "Mesh frequency (Hz)", .speed = true};
  std::vector<Panel> out;
  out.push_back({.heading = "transmission error " + where,
                 .x = periods,
                 .y = {.label = "DTE (µm)"},
                 .curves = {{.block = "signal", .width = 1.4}},
                 .height = 200});
  out.push_back({.heading = "residual signal: less the mean of its mesh periods",
                 .x = periods,
                 .y = {.label = "Residual (µm)"},
                 .curves = {{.block = "signal", .y = 3, .colour = kVermilion, .width = 1.4}},
                 .height = 200});
  out.push_back({.heading = "orders: harmonics of the mesh frequency, sidebands beside them",
                 .x = {.label = "Order of the mesh frequency", .from = 0, .to = kLastOrder},
                 .y = {.label = "Amplitude (µm)", .log = true},
                 .curves = {{.block = "orders", .style = PanelStyle::stems, .width = 1.8, .size = 0}},
                 .height = 230});
  out.push_back({.heading = "RMS of the residual signal",
                 .x = speed,
                 .y = {.label = "RMS (µm)", .from_zero = true},
                 .curves = {{.block = "speeds", .colour = kVermilion}},
                 .height = 180});
  out.push_back({.heading = "kurtosis of the residual signal; 3: noise",
                 .x = speed,
                 .y = {.label = "Kurtosis", .from_zero = true},
                 .curves = {{.block = "speeds", .y = 3, .colour = kPurple}},
                 .rules = {{'y', 3}},
                 .height = 180});
  return out;
}

}  // namespace

Figure residual_figure(const SweepResult& sweep, const ResponseResult& r) {
  if (r.hunting_periods < 2)
    fail(
        Failure::input,
        "figure: the teeth are all alike and have no residual signal; give a gear of the scene a section [gear.<name>.error] or [gear.<name>.crack]");
  if (sweep.mesh_frequency != r.mesh_frequency || sweep.hunting_periods != r.hunting_periods ||
      sweep.mesh_names != r.mesh_names)
    fail(Failure::input, "figure: sweep.h5 and response.h5 are of other speeds, teeth or meshes (",
         sweep.mesh_frequency.size(), " and ", r.mesh_frequency.size(), " speeds, ", sweep.hunting_periods,
         " and ", r.hunting_periods, " mesh periods); give those of one sweep");
  Index speed = 0, mesh = 0;
  const double most = r.residual_rms.maxCoeff(&speed, &mesh);
  const std::string name = r.mesh_names[static_cast<size_t>(mesh)];
  Figure figure;
  figure.title = "Teeth that differ in motion: residual signal and sidebands";
  figure.notes = {text("mesh of ", name, ", speed ", r.direction == Direction::up ? "rising" : "falling",
                       r.of_train() ? "; of all meshes that with the largest residual signal" : ""),
                  text("the same teeth meet after ", r.hunting_periods, " mesh periods: sidebands are ",
                       shown(1.0 / r.hunting_periods, 4), " of the mesh frequency apart"),
                  text("at ", fixed(r.mesh_frequency[speed], 0), " Hz the residual signal has an RMS of ",
                       shown(most * kMicro, 3), " µm, ", shown(kPercent * most / r.dte_rms(speed, mesh), 3),
                       " % of that of the transmission error, and a kurtosis of ",
                       fixed(r.residual_kurtosis(speed, mesh), 1))};
  add_signal(sweep, r, speed, mesh, figure);
  add_speeds(r, mesh, figure);
  if (r.of_train())
    add_shafts(r.layout, figure);
  else
    figure.shafts = shafts_of(r);
  figure.panels = panels_of_signal(r, "at " + fixed(r.mesh_frequency[speed], 0) + " Hz");
  plain_captions(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
