#include "report/system_sweep_figure.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "dynamics/system_coordinates.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "report/system_picture.h"
#include "system/rigid_system.h"

namespace whine {

using Eigen::Index;

namespace {

struct Quantity {
  const char *name, *axis, *unit;
  double scale;
  MatrixRM SystemSweepResult::*values;  // (speed, mesh or body)
  bool of_bodies;
};
constexpr Quantity kQuantities[] = {
    {"dte_rms", "RMS of the transmission error", "µm", kMicro, &SystemSweepResult::dte_rms, false},
    {"separation_fraction", "Time without contact", "%", kPercent, &SystemSweepResult::separation_fraction,
     false},
    {"bearing_force_rms", "Bearing force, oscillating (RMS)", "N", 1, &SystemSweepResult::bearing_force_rms,
     true}};

std::vector<std::string> curve_names(const System& s, bool bodies) {
  std::vector<std::string> out;
  if (!bodies)
    for (size_t m = 0; m < s.meshes.size(); ++m) out.push_back(mesh_name(s, m));
  for (const System::Body& body : s.bodies)
    if (bodies) out.push_back(body.name + (body.on != System::kGround ? " (pin)" : ""));
  return out;
}

std::string column_of(const Quantity& q, const std::string& curve) {
  return text(q.name, " ", curve, " [", q.unit, "]");
}

FigureBlock block_of(const Quantity& q, const SystemSweepResult& a, size_t curves) {
  const std::vector<std::string> names = curve_names(a.settings.layout, q.of_bodies);
  const std::string way = name_of(a.direction);
  FigureBlock block{text(q.name, " ", way), {"mesh_frequency [Hz]"}, {}, text(q.name, "_", way)};
  for (size_t i = 0; i < curves; ++i) block.columns.push_back(column_of(q, names[i]));
  std::vector<Index> order(static_cast<size_t>(a.mesh_frequency.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index x, Index y) { return a.mesh_frequency[x] < a.mesh_frequency[y]; });
  for (const Index i : order) {
    std::vector<double> row{a.mesh_frequency[i]};
    row.reserve(curves + 1);
    for (size_t c = 0; c < curves; ++c) row.push_back((a.*q.values)(i, static_cast<Index>(c)) * q.scale);
    block.rows.push_back(row);
  }
  return block;
}

}  // namespace

Figure system_sweep_figure(const std::vector<SystemSweepResult>& sweeps) {
  for (const SystemSweepResult& one : sweeps)
    if (one.mesh_frequency.size() == 0 || one.settings.layout.meshes.empty())
      fail(Failure::input, "figure: a sweep of no speeds, or of a system without meshes, was given");
  const SystemSweepResult& a = sweeps.front();
  const System& s = a.settings.layout;
  require_one_system("another sweep", a.settings, a.torque, sweeps);
  Figure figure;
  figure.title = "A system over its speeds: vibration, contact loss, forces on bearings";
  figure.notes = in_lines(bodies_words(s, a.torque));
  figure.notes.push_back(text("body \"", a.settings.fidelity.body, "\", contact \"",
                              a.settings.fidelity.contact, "\", damping ",
                              shown(a.settings.damping.rayleigh_stiffness, 3), " s x stiffness + ",
                              shown(a.settings.damping.rayleigh_mass, 3), " 1/s x mass"));
  bool pins = false;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b) pins = pins || on_rigid_moving_pin(s, b);
  figure.notes.push_back(
      text("lines: rising speed; open marks: falling speed; force on a rigid axis: sum of the contact forces",
           pins ? ", on a rigid pin less the inertia force of the planet" : ""));
  int row_number = 0;
  double from = a.mesh_frequency.minCoeff(), to = a.mesh_frequency.maxCoeff();
  for (const Quantity& q : kQuantities) {
    std::vector<std::string> names = curve_names(s, q.of_bodies);
    if (names.size() > kMostLines)
      figure.notes.push_back(text(q.axis, ": the first ", kMostLines, " of ", names.size(), " curves"));
    const size_t curves = std::min(names.size(), kMostLines);
    double most = 0;
    for (const SystemSweepResult& sweep : sweeps) {
      figure.blocks.push_back(block_of(q, sweep, curves));
      most = std::max(most, (sweep.*q.values).leftCols(static_cast<Index>(curves)).maxCoeff() * q.scale);
      from = std::min(from, sweep.mesh_frequency.minCoeff());
      to = std::max(to, sweep.mesh_frequency.maxCoeff());
    }
    std::vector<std::string> labels;
    labels.reserve(curves);
    for (size_t i = 0; i < curves; ++i) {
      labels.push_back(short_name(names[i]));
      if (q.values == &SystemSweepResult::dte_rms) figure.levels.push_back({column_of(q, names[i]), false});
    }
    const std::string row = std::to_string(++row_number);
    for (const auto& [name, value] :
         {std::pair{"curves", static_cast<double>(curves)}, std::pair{"most", most > 0 ? 1.06 * most : 1.0}})
      figure.numbers.emplace_back(name + row, value);
    for (const auto& [name, word] :
         {std::pair{"quantity", std::string(q.name)}, std::pair{"axis", std::string(q.axis)},
          std::pair{"unit", std::string(q.unit)}, std::pair{"labels", quoted_labels(labels)}})
      figure.words.emplace_back(name + row, word);
  }
  for (const Direction way : {Direction::up, Direction::down}) {
    double there = 0;
    for (const SystemSweepResult& sweep : sweeps) there += sweep.direction == way;
    figure.numbers.emplace_back(text("sweeps_", name_of(way)), there);
  }
  figure.numbers.emplace_back("frequency_from", from);
  figure.numbers.emplace_back("frequency_to", to);
  figure.numbers.emplace_back("notes", static_cast<double>(figure.notes.size()));
  add_shafts(s, figure);
  figure.height = 1550 + 24 * static_cast<int>(figure.notes.size());
  add_lines(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
