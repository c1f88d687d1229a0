#include "report/figure_list.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "gear/layout.h"
#include "report/distinct_curves.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "report/system_picture.h"

namespace whine {

using Eigen::Index;

namespace {

enum class Parts { meshes, bearings, gears, whole };
struct Quantity {
  const char *name, *heading, *axis, *unit;
  double scale;
  MatrixRM (*values)(const ResponseResult&);  // (speed, part); empty: the sweeps do not have it
  Parts parts;
};

// (speed, gear): largest sustained root stress in any mesh of each gear; gears stand before carriers.
MatrixRM root_stress_of_gears(const ResponseResult& a) {
  if (a.root_stress_sustained.size() == 0) return {};
  const System& s = a.layout;
  const auto gears = std::count_if(s.bodies.begin(), s.bodies.end(), [](const System::Body& body) {
    return body.kind == System::BodyKind::gear;
  });
  MatrixRM out = MatrixRM::Zero(a.mesh_frequency.size(), gears);
  for (size_t m = 0; m < s.meshes.size(); ++m)
    for (size_t side = 0; side < kSides; ++side) {
      auto own = out.col(s.meshes[m].side[side].body);
      own = own.cwiseMax(a.root_stress_sustained.col(static_cast<Index>(kSides * m + side)));
    }
  return out;
}

constexpr Quantity kQuantities[] = {
    {"dte_rms", "RMS of the transmission error", "RMS", "µm", kMicro,
     [](const ResponseResult& a) { return a.dte_rms; }, Parts::meshes},
    {"separation_fraction", "Time without contact", "Time", "%", kPercent,
     [](const ResponseResult& a) { return a.separation_fraction; }, Parts::meshes},
    {"bearing_force_rms", "Bearing force, oscillating (RMS)", "Force", "N", 1,
     [](const ResponseResult& a) { return a.bearing_force_rms; }, Parts::bearings},
    {"root_stress_sustained", "Largest root stress of each gear, sustained", "Stress", "MPa", kInMegapascals,
     root_stress_of_gears, Parts::gears},
    {"efficiency", "Efficiency, friction between the flanks alone", "Efficiency", "%", kPercent,
     [](const ResponseResult& a) { return MatrixRM(a.friction.efficiency); }, Parts::whole}};

std::vector<std::string> curve_names(const System& s, Parts parts) {
  std::vector<std::string> out;
  if (parts == Parts::whole) return {"train"};
  if (parts == Parts::meshes)
    for (size_t m = 0; m < s.meshes.size(); ++m) out.push_back(mesh_name(s, m));
  else
    for (const System::Body& body : s.bodies)
      if (parts == Parts::bearings || body.kind == System::BodyKind::gear)
        out.push_back(body.name + (parts == Parts::bearings && body.on != System::kGround ? " (pin)" : ""));
  return out;
}

std::string column_of(const Quantity& q, const std::string& curve) {
  return text(q.name, " ", curve, " [", q.unit, "]");
}

FigureBlock block_of(const Quantity& q, const ResponseResult& a, size_t curves) {
  const std::vector<std::string> names = curve_names(a.layout, q.parts);
  const MatrixRM values = q.values(a);
  const std::string way = name_of(a.direction);
  FigureBlock block{text(q.name, " ", way), {"mesh_frequency [Hz]"}, {}, text(q.name, "_", way)};
  for (size_t i = 0; i < curves; ++i) block.columns.push_back(column_of(q, names[i]));
  std::vector<Index> order(static_cast<size_t>(a.mesh_frequency.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index x, Index y) { return a.mesh_frequency[x] < a.mesh_frequency[y]; });
  for (const Index i : order) {
    if (!block.rows.empty() && jumps_between(a, block.rows.back()[0], a.mesh_frequency[i]))
      block.rows.emplace_back();  // lifts the pen
    std::vector<double> row{a.mesh_frequency[i]};
    row.reserve(curves + 1);
    for (size_t c = 0; c < curves; ++c) row.push_back(values(i, static_cast<Index>(c)) * q.scale);
    block.rows.push_back(row);
  }
  return block;
}

// By the sweeps in both directions.
std::vector<size_t> distinct_of(const Quantity& q, const std::vector<ResponseResult>& sweeps, size_t curves) {
  std::vector<Eigen::VectorXd> all(curves);
  double low = q.parts == Parts::whole ? std::numeric_limits<double>::infinity() : 0, high = -low;
  for (const ResponseResult& sweep : sweeps) {
    const MatrixRM values = q.values(sweep);
    low = std::min(low, values.minCoeff());
    high = std::max(high, values.maxCoeff());
    for (size_t i = 0; i < curves; ++i) {
      const Index before = all[i].size();
      all[i].conservativeResize(before + values.rows());
      all[i].tail(values.rows()) = values.col(static_cast<Index>(i));
    }
  }
  return distinct_curves(all, high - low);
}

// Where curves are near each other for a while, dashes and the wider line below let both show.
void add_curves(const Quantity& q, const std::vector<ResponseResult>& sweeps, size_t i,
                const std::vector<size_t>& numbers, const std::string& name, Panel& panel) {
  const size_t n = numbers[i];
  PanelCurve curve{.y = static_cast<int>(i) + 2,
                   .colour = curve_colour(n),
                   .width = 1.6 + 0.7 * static_cast<double>(count_of_distinct(numbers) - 1 - n),
                   .dash = n < 2   ? 1
                           : n < 4 ? 2
                           : n < 6 ? 4
                                   : 3,
                   .mark = n < 6 ? 6 : 4,
                   .size = 0.9};
  for (const ResponseResult& sweep : sweeps) {
    if (!is_first(numbers, i)) break;
    curve.block = text(q.name, " ", name_of(sweep.direction));
    curve.style = sweep.direction == Direction::up ? PanelStyle::line : PanelStyle::points;
    panel.curves.push_back(curve);
  }
  curve.block = "";
  curve.style = PanelStyle::line_points;
  curve.label = without_markup(name);
  curve.width = 1.8;
  panel.curves.push_back(curve);
}

}  // namespace

Figure system_sweep_figure(const std::vector<ResponseResult>& sweeps) {
  for (const ResponseResult& one : sweeps)
    if (one.mesh_frequency.size() == 0 || one.layout.meshes.empty())
      fail(Failure::input, "figure: a sweep of no speeds, or of a system without meshes, was given");
  const ResponseResult& a = sweeps.front();
  const System& s = a.layout;
  require_one_system("another sweep", a, sweeps);
  Figure figure;
  figure.title = "A train over its speeds: vibration, contact loss, forces on bearings, root stress";
  figure.notes = in_lines(bodies_words(s, a.drive));
  figure.notes.push_back(text("body \"", a.fidelity.body, "\", contact \"", a.fidelity.contact,
                              "\", damping ", shown(a.damping.rayleigh_stiffness, 3), " s x stiffness + ",
                              shown(a.damping.rayleigh_mass, 3), " 1/s x mass"));
  bool pins = false;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b) pins = pins || on_rigid_moving_pin(s, b);
  if (const std::string jumps = jump_note(sweeps); !jumps.empty()) figure.notes.push_back(jumps);
  figure.notes.push_back(
      text("lines: rising speed; open marks: falling speed; force on a rigid axis: sum of the contact forces",
           pins ? ", on a rigid pin less the inertia force of the planet" : ""));
  bool alike = false;
  for (const Quantity& q : kQuantities) {
    if (std::any_of(sweeps.begin(), sweeps.end(),
                    [&](const ResponseResult& one) { return q.values(one).size() == 0; }))
      continue;
    const std::vector<std::string> names = curve_names(s, q.parts);
    if (names.size() > kMostLines)
      figure.notes.push_back(text(q.heading, ": the first ", kMostLines, " of ", names.size(), " curves"));
    const size_t curves = std::min(names.size(), kMostLines);
    const bool vibration = &q == &kQuantities[0];
    const std::vector<size_t> numbers = distinct_of(q, sweeps, curves);
    alike = alike || count_of_distinct(numbers) < curves;
    for (const ResponseResult& sweep : sweeps) figure.blocks.push_back(block_of(q, sweep, curves));
    Panel panel{.heading = q.heading,
                .x = {.label = "Mesh frequency (Hz)", .speed = true},
                .y = {.label = text(q.axis, " (", q.unit, ")"),
                      .from_zero = q.parts != Parts::whole,
                      .level = vibration}};
    for (size_t i = 0; i < curves; ++i) {
      if (vibration) figure.levels.push_back({column_of(q, names[i]), false});
      add_curves(q, sweeps, i, numbers, short_name(names[i]), panel);
    }
    figure.panels.push_back(panel);
  }
  if (alike) figure.notes.emplace_back(kOneColour);
  add_shafts(s, figure);
  plain_captions(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
