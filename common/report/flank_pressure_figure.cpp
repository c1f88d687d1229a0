#include "report/figure_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/units.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;

void require_pressures(const StaticResult& s, const std::vector<ResponseResult>& sweeps) {
  if (sweeps.size() != 2 || sweeps[0].direction == sweeps[1].direction)
    fail(Failure::input, "flank-pressure: it needs two response.h5 beside static.h5, up and down; ",
         sweeps.size(), " given");
  for (const ResponseResult& r : sweeps) {
    if (r.torque != s.torque)
      fail(Failure::input, "flank-pressure: a response.h5 of ", r.torque, " N m; static.h5 is of ", s.torque,
           " N m; give both of one torque");
    if (r.flank_pressure.size() == 0 || r.flank_pressure_sustained.size() != r.mesh_frequency.size())
      fail(Failure::input, "flank-pressure: the response.h5 of the sweep ", r.direction,
           " holds no flank pressure, which lumped models do not have");
  }
}

// deg: of the driver where a pair at this phase would touch on the line of action, so that places beyond its ends, where tip edges
// touch, stand apart.
double nominal_roll(const GearPair& pair, double phase) {
  return pair.nominal_roll(0, phase * pair.base_pitch()) * kInDegrees;
}

FigureBlock map_block(const ResponseResult& r, const GearPair& pair) {
  FigureBlock block{text("map ", r.direction),
                    {"roll_" + r.mesh.gear[0] + " [deg]", "roll_" + r.mesh.gear[1] + " [deg]",
                     "pair_phase [1]", "mesh_frequency [Hz]", "pressure [MPa]", "load over a tip edge [N]",
                     "roll_" + r.mesh.gear[0] + " on the line of action [deg]"},
                    {},
                    "map",
                    name_of(r.direction)};
  for (Index f = 0; f < r.mesh_frequency.size(); ++f)
    for (Index k = 0; k < r.pair_phase.size(); ++k)
      block.rows.push_back({r.flank_roll(k, 0) * kInDegrees, r.flank_roll(k, 1) * kInDegrees, r.pair_phase[k],
                            r.mesh_frequency[f], r.flank_pressure(f, k) * kInMegapascals,
                            r.edge_load_there(f, k), nominal_roll(pair, r.pair_phase[k])});
  return block;
}

FigureBlock pressure_block(const ResponseResult& r, const ResponseResult& other) {
  FigureBlock block{text("speed ", r.direction),
                    {"mesh_frequency [Hz]", "pressure [MPa]", "edge_load_" + r.mesh.gear[0] + " [N]",
                     "edge_load_" + r.mesh.gear[1] + " [N]"},
                    {},
                    "speed",
                    name_of(r.direction)};
  const std::vector<bool> broken = broken_after(r, &other);
  for (Index f = 0; f < r.mesh_frequency.size(); ++f) {
    block.rows.push_back({r.mesh_frequency[f], r.flank_pressure_sustained[f] * kInMegapascals,
                          r.edge_load(f, 0), r.edge_load(f, 1)});
    if (broken[static_cast<size_t>(f)]) block.rows.emplace_back();
  }
  return block;
}

// 1: largest difference of the two maps over the largest pressure; infinity for other speeds.
double difference(const ResponseResult& up, const ResponseResult& down) {
  const Index speeds = up.mesh_frequency.size();
  if (down.mesh_frequency.size() != speeds || down.flank_pressure.cols() != up.flank_pressure.cols())
    return std::numeric_limits<double>::infinity();
  double off = 0;
  for (Index f = 0; f < speeds; ++f) {
    if (up.mesh_frequency[f] != down.mesh_frequency[speeds - 1 - f])
      return std::numeric_limits<double>::infinity();
    off = std::max(
        off, (up.flank_pressure.row(f) - down.flank_pressure.row(speeds - 1 - f)).cwiseAbs().maxCoeff());
  }
  const double most = std::max(up.flank_pressure.maxCoeff(), down.flank_pressure.maxCoeff());
  return most > 0 ? off / most : std::numeric_limits<double>::infinity();
}

// Over roll angle and speed; grey lines stand at the ends of the line of action.
Panel map_panel(const ResponseResult& r, const GearPair& pair, double largest) {
  const Index last = r.pair_phase.size() - 1, speeds = r.mesh_frequency.size();
  const Eigen::VectorXd roll =
      r.pair_phase.unaryExpr([&](double phase) { return nominal_roll(pair, phase); });
  // Between places side by side; beyond the line of action some may be left out.
  const double step = last > 0 ? (roll.tail(last) - roll.head(last)).minCoeff() : 1;
  const double tall =
      speeds > 1 ? std::abs(r.mesh_frequency[1] - r.mesh_frequency[0]) : 0.2 * r.mesh_frequency[0];
  PanelCurve edges{.block = text("map ", r.direction),
                   .x = 7,
                   .y = 4,
                   .style = PanelStyle::cells,
                   .colour = kGrey,
                   .width = 1.06 * step,
                   .size = 1.06 * tall,
                   .where = 6};
  PanelCurve inside = edges;
  inside.where = inside.heat = 5;
  return {
      .heading = text("speed ", r.direction == Direction::up ? "rising" : "falling"),
      .x = {.label = "Roll angle of " + without_markup(r.mesh.gear[0]) + " (deg)",
            .from = roll[0] - 0.53 * step,
            .to = roll[last] + 0.53 * step},
      .y = {.label = "Mesh frequency (Hz)", .speed = true},
      .curves = {edges, inside},
      .rules = {{.at = nominal_roll(pair, pair.path_start() / pair.base_pitch()), .colour = kDark, .dash = 1},
                {.at = nominal_roll(pair, pair.path_end() / pair.base_pitch()), .colour = kDark, .dash = 1}},
      .key = PanelKey::none,
      .height = 420,
      .wide = true,
      .colours = PanelAxis{.label = "Pressure (MPa)", .from = 0, .to = largest > 0 ? largest : 1}};
}

Panel over_speed(const ResponseResult& r, const std::string& heading, const std::string& label) {
  return {.heading = heading,
          .x = {.label = "Mesh frequency (Hz)", .speed = true},
          .y = {.label = label, .from_zero = true},
          .rules = {{.at = r.natural_frequency, .label = "f_n"}},
          .key = PanelKey::below};
}

Panel pressure_panel(const ResponseResult& r, double at_rest) {
  Panel panel = over_speed(r, "largest inside the flanks", "Largest pressure (MPa)");
  panel.curves = {
      {.block = "speed up", .label = "rising", .width = 2.6, .where = 2},
      {.block = "speed down", .colour = kVermilion, .label = "falling", .width = 1.8, .dash = 3, .where = 2}};
  if (at_rest > 0)
    panel.rules.push_back(
        {.axis = 'y', .at = at_rest, .label = "at rest", .colour = kDark, .dash = 4, .in_key = true});
  return panel;
}

// Of driver and driven gear, the second drawn over the first.
Panel edge_panel(const ResponseResult& r) {
  Panel panel = over_speed(r, "load of a pair over a tip edge", "Load over a tip edge (N)");
  for (const bool up : {true, false})
    for (int g = 0; g < kSides; ++g)
      panel.curves.push_back({.block = up ? "speed up" : "speed down",
                              .y = g + 3,
                              .colour = curve_colour(static_cast<size_t>(g)),
                              .label = up ? "edge of " + without_markup(short_name(r.mesh.gear[g])) : "",
                              .width = g == 0 ? 3.6 : 1.6,
                              .dash = up ? 1 : 3});
  panel.curves.push_back({.colour = kDark, .label = "dashed: falling", .dash = 3});
  return panel;
}

}  // namespace

Figure flank_pressure_figure(const StaticResult& s, const std::vector<ResponseResult>& given) {
  require_pressures(s, given);
  const bool in_order = given[0].direction == Direction::up;
  const ResponseResult &up = given[in_order ? 0 : 1], &down = given[in_order ? 1 : 0];
  constexpr double kAlike = 0.01;
  const bool both = difference(up, down) > kAlike;
  Figure figure;
  figure.title = "Flank pressure (MPa) and loads over tip edges (N), " + torque_words(s.torque);
  figure.shafts = shafts_of(s);
  const FlankPressure& rest = s.flank_pressure;
  const GearPair pair(s);
  figure.blocks.push_back(map_block(up, pair));
  if (both) figure.blocks.push_back(map_block(down, pair));
  double largest = 0, edge = 0;
  for (const ResponseResult* r : {&up, &down}) {
    figure.blocks.push_back(pressure_block(*r, r == &up ? down : up));
    largest = std::max({largest, r->flank_pressure.maxCoeff(), r->flank_pressure_sustained.maxCoeff()});
    if (r->edge_load.size() > 0) edge = std::max(edge, r->edge_load.maxCoeff());
  }
  const std::string all[] = {
      "pressure inside the flanks, by Hertz's law of the load that a pair sustains for 1/64 of a mesh period; largest over the mesh periods" +
          (rest.smooth > 0 ? "; at rest, by strips, " + shown(rest.smooth * kInMegapascals, 4) + " MPa" : ""),
      text("grey: sustained over a tip edge, whose pressure is singular and stated as a load (",
           both ? "d" : "c", "); white: no load is sustained; grey lines: ends of the line of action"),
      both ? "the map of falling speed differs from that of rising speed"
           : "falling speed has the same map within 1 % of the largest pressure"};
  for (const std::string& note : all) figure.notes.push_back(note);
  figure.captions = figure.notes;
  figure.columns = 2;
  for (const ResponseResult* r : {&up, &down})
    if (r == &up || both) figure.panels.push_back(map_panel(*r, pair, largest * kInMegapascals));
  figure.panels.push_back(pressure_panel(up, rest.smooth * kInMegapascals));
  figure.panels.push_back(edge_panel(up));
  return figure;
}

}  // namespace whine
