#include "report/figure_list.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "report/distinct_curves.h"
#include "report/one_system.h"
#include "report/system_picture.h"
#include "signal/orders.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kRunupOrders = 4;
constexpr Index kSlices = 400, kBands = 300, kMostPoints = 1200;
constexpr double kHighest = 5.0 / 12;  // of the sample rate: what the record holds undamped

// The mesh that vibrates most, of which spectrogram and orders are.
Index shown_mesh(const RunupResult& a) {
  Index row = 0, mesh = 0;
  a.periods.dte_rms.maxCoeff(&row, &mesh);
  return mesh;
}

std::string of_mesh(const RunupResult& a, Index mesh) {
  return a.of_train() ? " of " + without_markup(a.mesh_names[static_cast<size_t>(mesh)]) : "";
}

PanelAxis speed_axis(const RunupResult& a) {
  return {.label = "Mesh frequency (Hz)",
          .from = std::min(a.ramp.from, a.ramp.to),
          .to = std::max(a.ramp.from, a.ramp.to),
          .speed = true};
}

// Spectrogram in dB re 1 N, RMS: of the bins of a band the one of largest amplitude, so that no line falls between two bands.
FigureBlock spectrogram_block(const RunupResult& a, Figure& figure) {
  const double top = std::max(a.ramp.from, a.ramp.to);
  const double most = std::min((kRunupOrders + 0.5) * top, kHighest * a.sample_rate);
  // The middle order moves twice as fast as the first.
  Index length = spectrogram_length(a.sample_rate, 2 * a.mesh_acceleration);
  // No longer than half the record, no finer than what is drawn, or rays would be hairs.
  constexpr Index kLeast = 64;
  const auto drawn = static_cast<Index>(4.0 / 3 * a.sample_rate / most * kBands);
  while (length > std::min(a.samples.size() / 2, drawn) && length > kLeast) length /= 2;
  const Index mesh = shown_mesh(a);
  const VectorXd force = a.samples.mesh_force.col(mesh), oscillating = force.array() - force.mean();
  const Spectrogram s = spectrogram(oscillating, a.sample_rate, length, kSlices, most);
  FigureBlock block{
      "spectrogram", {"mesh_frequency [Hz]", "frequency [Hz]", "mesh_force [dB re 1 N RMS]"}, {}};
  block.drawing = true;
  const Index bins = s.frequency.size() - 1, bands = std::min(kBands, bins);
  double loudest = -300;
  for (Index i = 0; i < kSlices; ++i) {
    const double f = a.ramp.from + a.mesh_acceleration * s.time[i];
    for (Index b = 0; b < bands; ++b) {
      const Index first = 1 + bins * b / bands, last = 1 + bins * (b + 1) / bands;
      const double amplitude = s.amplitude.row(i).segment(first, last - first).maxCoeff();
      const double level = 20 * std::log10(std::max(amplitude, 1e-9) / std::numbers::sqrt2);
      loudest = std::max(loudest, level);
      block.rows.push_back({f, 0.5 * (s.frequency[first] + s.frequency[last - 1]), level});
    }
    block.rows.emplace_back();
  }
  Panel panel{
      .heading = "spectrogram of the mesh force" + of_mesh(a, mesh),
      .x = speed_axis(a),
      .y = {.label = "Frequency (Hz)", .from = 0, .to = most},
      .top = PanelAxis{.label = "Speed of " + without_markup(a.input) + " (rpm)"},
      .top_factor = a.ramp.rate / std::abs(a.mesh_acceleration),
      .curves = {{.block = "spectrogram", .style = PanelStyle::image, .heat = 3}},
      .height = 400,
      .colours = PanelAxis{.label = "Mesh force (dB re 1 N RMS)", .from = loudest - 60, .to = loudest}};
  if (!a.of_train()) {
    panel.rules = {{.axis = 'y', .at = a.natural_frequency, .colour = kBlack}};
    panel.words.push_back({"f_n", 0.5 * (panel.x.from + panel.x.to), a.natural_frequency});
  }
  for (int k = 1; k <= kRunupOrders && k * top < most; ++k) panel.words.push_back({text(k), top, k * top});
  figure.panels.push_back(panel);
  figure.notes.push_back(text("(a) Hann windows of ",
                              shown(static_cast<double>(length) / a.sample_rate * kMilli, 3),
                              " ms, RMS of lines in dB re 1 N; orders of the mesh frequency are rays",
                              a.of_train() ? "" : ", f_n natural frequency of the mesh"));
  return block;
}

FigureBlock order_block(const RunupResult& a, Figure& figure) {
  const VectorXd phase = a.samples.time.unaryExpr([&](double t) { return a.mesh_phase(t); });
  const int width = order_width(0.5 * (a.ramp.from + a.ramp.to), a.mesh_acceleration);
  const int orders = std::clamp(static_cast<int>(kHighest * a.sample_rate / std::max(a.ramp.from, a.ramp.to)),
                                1, kRunupOrders);
  const Index mesh = shown_mesh(a);
  const OrderCuts cuts = order_cuts(a.samples.transmission_error.col(mesh), phase, orders, width);
  FigureBlock block{"orders", {"time [s]", "mesh_frequency [Hz]"}, {}};
  for (int n = 1; n <= orders; ++n) block.columns.push_back(text("order_", n, " [µm]"));
  const Index stride = std::max<Index>(1, cuts.phase.size() / (4 * kMostPoints));
  for (Index c = 0; c < cuts.phase.size(); c += stride) {
    const double squared = a.ramp.from * a.ramp.from + 2 * a.mesh_acceleration * cuts.phase[c];
    const double f = std::sqrt(squared);
    std::vector<double> row{(f - a.ramp.from) / a.mesh_acceleration, f};
    for (int n = 0; n < orders; ++n) row.push_back(cuts.amplitude(c, n) * kMicro);
    block.rows.push_back(std::move(row));
  }
  Panel panel{.heading = "orders of the transmission error" + of_mesh(a, mesh),
              .x = speed_axis(a),
              .y = {.label = "Amplitude (µm)", .from_zero = true, .level = true},
              .height = 260};
  for (int n = 1; n <= orders; ++n)
    panel.curves.push_back(
        {.block = "orders", .x = 2, .y = n + 2, .colour = n, .label = text("order ", n), .width = 2.2});
  figure.panels.push_back(panel);
  figure.notes.push_back(text("(b) orders in Hann windows of ", width,
                              " mesh periods over the angle (transform over the phase of the ramp)"));
  return block;
}

// Extremes of groups of mesh periods, so that what is short remains; of trains of each mesh.
FigureBlock runup_period_block(const RunupResult& a, Figure& figure) {
  FigureBlock block{"periods", {"mesh_frequency [Hz]"}, {}};
  const auto name = [&](Index m) { return a.of_train() ? a.mesh_names[static_cast<size_t>(m)] : ""; };
  for (const char* of : {"tooth_load_max", "separation_fraction"})
    for (Index m = 0; m < a.meshes(); ++m)
      block.columns.push_back(text(of, a.of_train() ? " of " : "", name(m),
                                   std::string(of) == "tooth_load_max" ? " [mean mesh force]" : " [%]"));
  const Eigen::RowVectorXd mean_force = a.samples.mesh_force.colwise().mean();
  const Index periods = a.periods.size(), stride = std::max<Index>(1, periods / kMostPoints);
  for (Index k = 0; k < periods; k += stride) {
    const Index n = std::min(stride, periods - k);
    std::vector<double> row{a.periods.mesh_frequency.segment(k, n).mean()};
    for (Index m = 0; m < a.meshes(); ++m)
      row.push_back(a.periods.tooth_load_max.col(m).segment(k, n).maxCoeff() / mean_force[m]);
    for (Index m = 0; m < a.meshes(); ++m)
      row.push_back(a.periods.separation_fraction.col(m).segment(k, n).maxCoeff() * kPercent);
    block.rows.push_back(std::move(row));
  }
  bool alike = false;
  const auto curves = [&](Index first, int colour) {
    std::vector<VectorXd> values;
    values.reserve(static_cast<size_t>(a.meshes()));
    double most = 0;
    for (Index m = 0; m < a.meshes(); ++m) {
      VectorXd& own = values.emplace_back(static_cast<Index>(block.rows.size()));
      for (size_t k = 0; k < block.rows.size(); ++k)
        own[static_cast<Index>(k)] = block.rows[k][static_cast<size_t>(first - 1 + m)];
      most = std::max(most, own.maxCoeff());
    }
    const std::vector<size_t> numbers = distinct_curves(values, most);
    alike = alike || count_of_distinct(numbers) < numbers.size();
    std::vector<PanelCurve> out;
    out.reserve(numbers.size());
    for (size_t m = 0; m < numbers.size(); ++m)
      out.push_back({.block = is_first(numbers, m) ? "periods" : "",
                     .y = static_cast<int>(first) + static_cast<int>(m),
                     .colour = a.of_train() ? curve_colour(numbers[m]) : colour,
                     .label = without_markup(name(static_cast<Index>(m))),
                     .width = 1.8,
                     .dash = numbers[m] < 6 ? 1 : 2});
    return out;
  };
  // A line of the key takes 30 pixels.
  const int height = std::clamp(30 * static_cast<int>(a.meshes()), 140, 420);
  figure.panels.push_back({.heading = "largest load of a tooth, over the mean mesh force",
                           .x = speed_axis(a),
                           .y = {.label = "Load (1)", .from_zero = true},
                           .curves = curves(2, kBlue),
                           .height = height});
  figure.panels.push_back({.heading = "share of the period without contact",
                           .x = speed_axis(a),
                           .y = {.label = "Time (%)", .from_zero = true},
                           .curves = curves(2 + a.meshes(), kVermilion),
                           .height = height});
  if (alike) figure.notes.emplace_back(kOneColour);
  return block;
}

// First order of the sweeps at the ramp's speeds; whether there is any.
bool add_sweeps(const RunupResult& a, const std::vector<ResponseResult>& sweeps, Figure& figure) {
  const double low = std::min(a.ramp.from, a.ramp.to), high = std::max(a.ramp.from, a.ramp.to);
  const Index mesh = shown_mesh(a);
  bool compared = false;
  for (const ResponseResult& r : sweeps) {
    if (r.of_train() != a.of_train() || r.dte_rms.cols() != a.meshes())
      fail(Failure::input, "the run-", a.direction, " has ", a.meshes(), " meshes, a sweep ",
           r.dte_rms.cols(), "; give sweeps of the same scene");
    if (a.of_train())
      require_one_system(text("the run-", a.direction), a, {r});
    else if (r.torque != a.torque)
      fail(Failure::input, "the run-", a.direction, " is at ", a.torque, " N m, a sweep at ", r.torque,
           " N m; give sweeps of the same torque");
    FigureBlock block{text("sweep ", r.direction), {"mesh_frequency [Hz]", "order_1 [µm]"}, {}};
    block.table = "sweeps";
    block.curve = text(r.direction);
    for (Index i = 0; i < r.mesh_frequency.size(); ++i)
      if (r.mesh_frequency[i] >= low && r.mesh_frequency[i] <= high && r.harmonics() > 0)
        block.rows.push_back({r.mesh_frequency[i], r.dte_harmonic[static_cast<size_t>(i)](0, mesh) * kMicro});
    if (block.rows.empty()) continue;
    figure.panels[1].curves.push_back({.block = block.name,
                                       .style = PanelStyle::points,
                                       .colour = kGrey,
                                       .label = text("order 1, sweep ", r.direction),
                                       .mark = r.direction == Direction::up ? 7 : 6,
                                       .size = 0.7});
    figure.blocks.push_back(std::move(block));
    compared = true;
  }
  return compared;
}

}  // namespace

Figure runup_figure(const RunupResult& a, const std::vector<ResponseResult>& sweeps) {
  Figure figure;
  const bool up = a.direction == Direction::up;
  figure.title = text("Run-", a.direction, " at ", a.ramp.rate, " rpm/s, ",
                      a.of_train() ? "of a train" : torque_words(a.torque));
  if (a.of_train()) figure.notes = in_lines(bodies_words(a.layout, a.drive));
  figure.blocks.push_back(spectrogram_block(a, figure));
  figure.blocks.push_back(order_block(a, figure));
  figure.blocks.push_back(runup_period_block(a, figure));
  if (add_sweeps(a, sweeps, figure))
    figure.notes.push_back("(b) dots: first order of the periodic motions of the speed sweeps");
  figure.notes.push_back(text(
      "(c, d) of each mesh period, at its time steps; load: what a pair sustains for 1/64 of it; the mesh frequency changes by ",
      shown(std::abs(a.mesh_acceleration), 4), " Hz/s, ", up ? "rising" : "falling", " for ",
      shown((a.ramp.to - a.ramp.from) / a.mesh_acceleration, 3), " s"));
  add_shafts(a, figure);
  for (int n = 1; n <= kRunupOrders; ++n) figure.levels.push_back({text("order_", n, " [µm]"), true});
  return figure;
}

}  // namespace whine
